#include "firmware/wire/n2k/node/information.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const Result<Information>& information) {
  EXPECT_TRUE(information.ok());
  return {information.value().begin(), information.value().end()};
}

/// In its field of 32 bytes.
Bytes padded(std::string text) {
  text.resize(32, '\xFF');
  return {text.begin(), text.end()};
}

TEST(ProductInformation, IsLaidOutByteForByteAsTheStandardSays) {
  // 2100 = 0x0834, the product's code, four texts of 32 bytes, level B (1), load 3.
  Bytes expected{0x34, 0x08, 0x02, 0x01};
  for (const char* text : {"model", "software", "version", "serial"}) {
    const Bytes field = padded(text);
    expected.insert(expected.end(), field.begin(), field.end());
  }
  expected.insert(expected.end(), {1, 3});
  EXPECT_EQ(bytes_of(product_information({.code = 0x0102,
                                          .model = "model",
                                          .software_version = "software",
                                          .model_version = "version",
                                          .serial = "serial",
                                          .load_equivalency = 3})),
            expected);
}

TEST(ProductInformation, OfAProductThatNobodyDescribedSaysEarshotCodeZeroAndNoLoad) {
  const Bytes bytes = bytes_of(product_information({}));
  ASSERT_EQ(bytes.size(), 134U);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 4), (Bytes{0x34, 0x08, 0, 0}));
  EXPECT_EQ(Bytes(bytes.begin() + 4, bytes.begin() + 36), padded("Earshot"));
  EXPECT_EQ(Bytes(bytes.begin() + 36, bytes.begin() + 132), Bytes(96, 0xFF));
  EXPECT_EQ(bytes[133], 0);
}

TEST(ProductInformation, IsRefusedWithATextThatDoesNotFit) {
  const std::string long_one(33, 'x');
  EXPECT_EQ(product_information({.model = long_one}).status(), Status::kOutOfRange);
  EXPECT_EQ(product_information({.serial = "\n"}).status(), Status::kOutOfRange);
}

TEST(ConfigurationInformation, HoldsThreeTextsOf70Characters) {
  const std::string most(70, 'x');
  const Bytes bytes = bytes_of(configuration_information({.installation_1 = most, .installation_2 = most, .manufacturer = most}));
  ASSERT_EQ(bytes.size(), 3U * 72U);
  for (const std::size_t at : {0U, 72U, 144U}) {
    EXPECT_EQ(bytes[at], 72) << "its size with this byte and the next";
    EXPECT_EQ(bytes[at + 1], 1) << "one byte a character";
  }
  const std::string more(71, 'x');
  EXPECT_EQ(configuration_information({.installation_1 = more}).status(), Status::kOutOfRange);
  EXPECT_EQ(configuration_information({.installation_2 = more}).status(), Status::kOutOfRange);
  EXPECT_EQ(configuration_information({.manufacturer = more}).status(), Status::kOutOfRange);
  EXPECT_EQ(configuration_information({.manufacturer = "\t"}).status(), Status::kOutOfRange);
}

TEST(ConfigurationInformation, OfADeviceThatNobodyDescribedHasThreeEmptyTexts) {
  EXPECT_EQ(bytes_of(configuration_information({})), (Bytes{2, 1, 2, 1, 2, 1}));
}

TEST(PgnList, HoldsUpTo74GroupsOfThreeBytes) {
  const std::vector<std::uint32_t> two{0x1F112, 0x3FFFF};
  EXPECT_EQ(bytes_of(pgn_list(PgnListKind::kTransmitted, two)), (Bytes{0, 0x12, 0xF1, 0x01, 0xFF, 0xFF, 0x03}));
  EXPECT_EQ(bytes_of(pgn_list(PgnListKind::kReceived, {})), Bytes{1});
  const std::vector<std::uint32_t> too_high{0x40000};
  EXPECT_EQ(pgn_list(PgnListKind::kReceived, too_high).status(), Status::kOutOfRange);
  EXPECT_EQ(bytes_of(pgn_list(PgnListKind::kReceived, std::vector<std::uint32_t>(74, 1))).size(), 223U);
  EXPECT_EQ(pgn_list(PgnListKind::kReceived, std::vector<std::uint32_t>(75, 1)).status(), Status::kOutOfRange);
}

TEST(TablePgns, AreEachListedOnceByTheirDirection) {
  const auto lists = [](PgnListKind kind, std::uint32_t pgn) { return std::ranges::count(table_pgns(kind), pgn); };
  using enum PgnListKind;
  EXPECT_EQ(lists(kTransmitted, kHeadingControlPgn), 1);
  EXPECT_EQ(lists(kReceived, kHeadingControlPgn), 0);
  EXPECT_EQ(lists(kTransmitted, kGnssPgn), 0);
  EXPECT_EQ(lists(kReceived, kGnssPgn), 1);
  for (const PgnListKind kind : {kTransmitted, kReceived}) {
    EXPECT_EQ(lists(kind, kAddressClaimPgn), 1) << "everybody sends and reads it";
    EXPECT_EQ(lists(kind, kPeerPgn), 1) << "of its three messages one is sent and two are read";
  }
}

}  // namespace
}  // namespace earshot::n2k
