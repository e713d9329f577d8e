#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/policy/tables/tables_bytes.hpp"

namespace earshot::policy::in_tables {
namespace {

TEST(SerialiseTables, PutsEverythingWhereTheReadmeSays) {
  const Bytes bytes = bytes_of(made_up_tables());
  ASSERT_EQ(bytes.size(), kSizeInAll);
  const auto text = [&bytes](std::size_t at, std::size_t size) {
    return std::string(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  };
  EXPECT_EQ(text(0, 8), "EARSHOTT");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kVersionAt), 1U);
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kLengthAt), kSizeInAll);
  EXPECT_EQ(text(kGridAt, 4), "GRID");
  EXPECT_EQ(value_at<std::uint16_t>(bytes, kGridAt + 4), 1U);
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kGridAt + 6), kOceansAt - kFrequencyAt);
  EXPECT_EQ(value_at<double>(bytes, kFrequencyAt), 20.0);
  EXPECT_EQ(value_at<double>(bytes, kReceiverAt), 300.0);
  EXPECT_EQ(value_at<double>(bytes, kSourceLeastAt), 10.0);
  EXPECT_EQ(value_at<double>(bytes, kSourceMostAt), 50.0);
  EXPECT_EQ(value_at<double>(bytes, kSeaLeastAt), 200.0);
  EXPECT_EQ(value_at<double>(bytes, kSeaMostAt), 4000.0);
  EXPECT_EQ(value_at<double>(bytes, kStepAt), 100.0);
  EXPECT_EQ(value_at<std::uint16_t>(bytes, kRangeCountAt), 3U);
  EXPECT_EQ(text(kOceansAt, 4), "OCNS");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kOceansAt + 6), kProvenanceAt - kTableCountAt);
  EXPECT_EQ(value_at<std::uint16_t>(bytes, kTableCountAt), 2U);
  EXPECT_EQ(text(kDeepAt, 5),
            "\x04"
            "deep");
  EXPECT_EQ(value_at<float>(bytes, kDeepPriorAt), 0.75F);
  EXPECT_EQ(value_at<float>(bytes, kDeepSeaAt), 3000.0F);
  EXPECT_EQ(text(kDeepSnrAt, 3), "\x28\xFD\x80");  // 40, -3, -128
  EXPECT_EQ(text(kShelfAt, 6),
            "\x05"
            "shelf");
  EXPECT_EQ(value_at<float>(bytes, kShelfPriorAt), 0.25F);
  EXPECT_EQ(text(kShelfSnrAt, 3), std::string("\x7F\0\x05", 3));
  EXPECT_EQ(text(kProvenanceAt, 4), "PROV");
  EXPECT_EQ(text(kProvenanceAt + 10, 6), "a = b\n");
  EXPECT_TRUE(std::equal(kPublicKey.begin(), kPublicKey.end(), bytes.begin() + kPublicKeyAt));
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kChecksumAt), crc32(std::span(bytes).first(kChecksumAt)));
  EXPECT_TRUE(std::all_of(bytes.end() - kSignatureSize, bytes.end(), [](std::uint8_t byte) { return byte == 0; }));
}

TEST(SerialiseTables, IsFullWhereThereIsNoRoom) {
  const auto tables = std::make_unique<OceanTables>(made_up_tables());
  for (std::size_t size = 0; size < kSizeInAll; ++size) {
    Bytes bytes(size);
    ASSERT_EQ(serialise(*tables, kPublicKey, bytes).status(), Status::kFull) << size;
  }
}

TEST(SerialiseTables, RefusesWhatParseWould) {
  const auto status_after = [](auto damage) {
    const auto tables = std::make_unique<OceanTables>(made_up_tables());
    damage(*tables);
    Bytes bytes(max_tables_size());
    return serialise(*tables, kPublicKey, bytes).status();
  };
  EXPECT_EQ(status_after([](OceanTables&) {}), Status::kOk);
  EXPECT_EQ(status_after([](OceanTables& tables) { tables.tables.clear(); }), Status::kOutOfRange);
  EXPECT_EQ(status_after([](OceanTables& tables) { tables.tables[0].prior = 0.0F; }), Status::kOutOfRange);
  EXPECT_EQ(status_after([](OceanTables& tables) { tables.range_count = config::kMaxTableRanges + 1; }), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::policy::in_tables
