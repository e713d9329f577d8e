#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>

#include "tests/firmware/policy/tables/tables_bytes.hpp"

namespace earshot::policy::in_tables {
namespace {

bool is(const PolicyComplaint& complaint, PolicyFault fault, std::string_view section) {
  return complaint.fault == fault && std::string_view(complaint.section.data(), complaint.section.size()) == section;
}

TEST(ParseTables, GivesThemBackAsTheyWere) {
  const auto before = std::make_unique<OceanTables>(made_up_tables());
  const Bytes bytes = bytes_of(*before);
  const auto after = std::make_unique<OceanTables>();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  EXPECT_TRUE(complaint.is_none());
  EXPECT_EQ(
      std::tuple(after->frequency, after->receiver_depth, after->source_depth, after->sea_depth, after->range_step, after->range_count),
      std::tuple(before->frequency, before->receiver_depth, before->source_depth, before->sea_depth, before->range_step,
                 before->range_count));
  EXPECT_EQ(after->provenance, before->provenance);
  ASSERT_EQ(after->tables.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after->tables[i].name, before->tables[i].name);
    EXPECT_EQ(after->tables[i].prior, before->tables[i].prior);
    EXPECT_EQ(after->tables[i].sea_depth_m, before->tables[i].sea_depth_m);
    EXPECT_EQ(after->tables[i].snr_half_db, before->tables[i].snr_half_db);
  }
  EXPECT_EQ(after->tables[0].snr_db(1), -1.5F);
  EXPECT_EQ(after->tables[1].snr_db(0), 63.5F);
}

TEST(ParseTables, MayReplaceLargerOnesInPlace) {
  const auto tables = std::make_unique<OceanTables>(made_up_tables());
  const Bytes bytes = bytes_of(*tables);
  tables->range_count = 300;
  while (tables->tables.push_back(made_up_table("one more", 1.0F, 1000.0F, {1})) == Status::kOk) {
  }
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *tables, complaint), Status::kOk);
  EXPECT_EQ(tables->tables.size(), 2U);
  EXPECT_EQ(bytes_of(*tables), bytes);
}

TEST(ParseTables, GivesAsManyBackAsThereMayBe) {
  const auto tables = std::make_unique<OceanTables>(made_up_tables());
  tables->range_count = config::kMaxTableRanges;
  tables->tables.clear();
  OceanTable table = made_up_table("a name of thirty-two bytes, whole", 1.0F, 1000.0F, {});
  ASSERT_EQ(table.name.size(), config::kMaxTableName);
  for (std::size_t i = 0; i < config::kMaxOceanTables; ++i) {
    table.snr_half_db.fill(static_cast<std::int8_t>(i));
    ASSERT_EQ(tables->tables.push_back(table), Status::kOk);
  }
  while (tables->provenance.push_back('x') == Status::kOk) {
  }
  const Bytes bytes = bytes_of(*tables);
  EXPECT_EQ(bytes.size(), max_tables_size());
  const auto after = std::make_unique<OceanTables>();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(ParseTables, FindsAFileTooShortWhereverItIsCut) {
  const Bytes bytes = bytes_of(made_up_tables());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_EQ(complaint_about(std::span(bytes).first(size)).fault, PolicyFault::kTooShort) << size;
}

TEST(ParseTables, RefusesBytesBehindTheEnd) {
  Bytes bytes = bytes_of(made_up_tables());
  bytes.push_back(0);
  EXPECT_EQ(complaint_about(bytes).fault, PolicyFault::kTooLong);
}

TEST(ParseTables, RefusesAnyBitFlippedBeforeTheSignature) {
  Bytes bytes = bytes_of(made_up_tables());
  for (std::size_t bit = 0; bit < 8 * (bytes.size() - kSignatureSize); ++bit) {
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    bytes[bit / 8] ^= mask;
    EXPECT_FALSE(complaint_about(bytes).is_none()) << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST(ParseTables, LeavesTheSignatureToTheShell) {
  Bytes bytes = bytes_of(made_up_tables());
  bytes.back() = 0xAA;
  EXPECT_TRUE(complaint_about(bytes).is_none());
}

TEST(ParseTables, TakesNoPolicyForThem) {
  EXPECT_EQ(complaint_about(policy::bytes_of(*small_policy())).fault, PolicyFault::kBadMagic);
}

TEST(ParseTables, NamesAnotherVersion) {
  for (const std::uint8_t version : Bytes{0, 2}) {
    const PolicyComplaint complaint = complaint_after([version](Bytes& bytes) { bytes[kVersionAt] = version; });
    EXPECT_EQ(complaint.fault, PolicyFault::kUnknownVersion);
    EXPECT_EQ(complaint.version, version);
  }
}

void insert(Bytes& bytes, std::size_t at, const Bytes& what) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), what.begin(), what.end());
}
void erase(Bytes& bytes, std::size_t begin, std::size_t end) {
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end));
}

TEST(ParseTables, NamesASectionThatIsUnknownOfAnotherVersionMissingOrThereTwice) {
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kOceansAt] = 'X'; }), PolicyFault::kUnknownSection, "XCNS"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) {
                   insert(bytes, kPublicKeyAt, {'N', 'E', 'T', 'W', 1, 0, 0, 0, 0, 0});
                 }),
                 PolicyFault::kUnknownSection, "NETW"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kGridAt + 4] = 2; }), PolicyFault::kUnknownSectionVersion, "GRID"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { erase(bytes, kOceansAt, kProvenanceAt); }), PolicyFault::kMissingSection, "OCNS"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { erase(bytes, kProvenanceAt, kPublicKeyAt); }), PolicyFault::kMissingSection, "PROV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) {
                   insert(bytes, kPublicKeyAt, {'P', 'R', 'O', 'V', 1, 0, 0, 0, 0, 0});
                 }),
                 PolicyFault::kSectionTwice, "PROV"));
}

TEST(ParseTables, NamesASectionThatIsNotAsLongAsWhatItHolds) {
  for (const std::uint32_t length : {0U, 57U, 59U, 0xFFFFFFFFU})
    EXPECT_TRUE(is(complaint_after([length](Bytes& bytes) { put(bytes, kGridAt + 6, length); }), PolicyFault::kBadSectionLength, "GRID"))
        << length;
  EXPECT_TRUE(
      is(complaint_after([](Bytes& bytes) { put(bytes, kTableCountAt, std::uint16_t{1}); }), PolicyFault::kBadSectionLength, "OCNS"));
  EXPECT_TRUE(
      is(complaint_after([](Bytes& bytes) { put(bytes, kTableCountAt, std::uint16_t{3}); }), PolicyFault::kBadSectionLength, "OCNS"));
}

TEST(ParseTables, NamesALastSectionThatSaysItIsLongerThanTheFile) {
  for (const std::uint32_t length : {7U, 0xFFFFFFFFU})
    EXPECT_TRUE(
        is(complaint_after([length](Bytes& bytes) { put(bytes, kProvenanceAt + 6, length); }), PolicyFault::kBadSectionLength, "PROV"))
        << length;
}

TEST(ParseTables, RefusesTablesOfAnotherGridThanTheirs) {
  for (const std::uint16_t ranges : {std::uint16_t{0}, std::uint16_t{2}, std::uint16_t{4}}) {
    Bytes bytes = bytes_of(made_up_tables());
    erase(bytes, kShelfAt, kProvenanceAt);
    put(bytes, kTableCountAt, std::uint16_t{1});
    put(bytes, kOceansAt + 6, static_cast<std::uint32_t>(kShelfAt - kTableCountAt));
    mend(bytes);
    ASSERT_TRUE(complaint_about(bytes).is_none());
    put(bytes, kRangeCountAt, ranges);
    mend(bytes);
    EXPECT_TRUE(is(complaint_about(bytes), PolicyFault::kBadSectionLength, "OCNS")) << ranges;
  }
}

TEST(ParseTables, RefusesMoreRangesThanItHolds) {
  for (const std::size_t ranges : {config::kMaxTableRanges + 1, std::size_t{0xFFFF}})
    EXPECT_TRUE(is(complaint_after([ranges](Bytes& bytes) { put(bytes, kRangeCountAt, static_cast<std::uint16_t>(ranges)); }),
                   PolicyFault::kBadShape, "GRID"))
        << ranges;
}

TEST(ParseTables, RefusesMoreTablesThanItHolds) {
  const auto with = [](std::size_t count) {
    return complaint_after([count](Bytes& bytes) {
      const Bytes deep(bytes.begin() + kDeepAt, bytes.begin() + kShelfAt);
      for (std::size_t i = 2; i < count; ++i) insert(bytes, kDeepAt, deep);
      put(bytes, kTableCountAt, static_cast<std::uint16_t>(count));
      put(bytes, kOceansAt + 6, static_cast<std::uint32_t>(kProvenanceAt - kTableCountAt + (count - 2) * deep.size()));
    });
  };
  EXPECT_TRUE(with(config::kMaxOceanTables).is_none());
  EXPECT_TRUE(is(with(config::kMaxOceanTables + 1), PolicyFault::kBadShape, "OCNS"));
}

TEST(ParseTables, RefusesNoTableAtAllOrNoRange) {
  const auto empty = [](Bytes& bytes) {
    erase(bytes, kDeepAt, kProvenanceAt);
    put(bytes, kTableCountAt, std::uint16_t{0});
    put(bytes, kOceansAt + 6, std::uint32_t{2});
  };
  EXPECT_TRUE(is(complaint_after(empty), PolicyFault::kBadShape, "OCNS"));
  const auto rangeless = [](Bytes& bytes) {
    erase(bytes, kShelfSnrAt, kProvenanceAt);
    erase(bytes, kDeepSnrAt, kShelfAt);
    put(bytes, kRangeCountAt, std::uint16_t{0});
    put(bytes, kOceansAt + 6, static_cast<std::uint32_t>(kProvenanceAt - kTableCountAt - 6));
  };
  EXPECT_TRUE(is(complaint_after(rangeless), PolicyFault::kBadShape, "GRID"));
}

TEST(ParseTables, RefusesAnOceanWithoutANameOrWithOneThatIsTooLong) {
  const auto nameless = [](Bytes& bytes) {
    bytes[kDeepAt] = 0;
    erase(bytes, kDeepAt + 1, kDeepPriorAt);
    put(bytes, kOceansAt + 6, static_cast<std::uint32_t>(kProvenanceAt - kTableCountAt - 4));
  };
  EXPECT_TRUE(is(complaint_after(nameless), PolicyFault::kBadShape, "OCNS"));
  const auto with_name_of = [](std::size_t size) {
    return complaint_after([size](Bytes& bytes) {
      bytes[kDeepAt] = static_cast<std::uint8_t>(size);
      insert(bytes, kDeepPriorAt, Bytes(size - 4, 'x'));
      put(bytes, kOceansAt + 6, static_cast<std::uint32_t>(kProvenanceAt - kTableCountAt + size - 4));
    });
  };
  EXPECT_TRUE(with_name_of(config::kMaxTableName).is_none());
  EXPECT_TRUE(is(with_name_of(config::kMaxTableName + 1), PolicyFault::kBadShape, "OCNS"));
}

TEST(ParseTables, RefusesMoreProvenanceThanItHolds) {
  const auto with = [](std::size_t size) {
    return complaint_after([size](Bytes& bytes) {
      insert(bytes, kPublicKeyAt, Bytes(size - 6, 'x'));
      put(bytes, kProvenanceAt + 6, static_cast<std::uint32_t>(size));
    });
  };
  EXPECT_TRUE(with(config::kMaxProvenance).is_none());
  EXPECT_TRUE(is(with(config::kMaxProvenance + 1), PolicyFault::kBadShape, "PROV"));
}

TEST(ParseTables, RefusesNumbersThatAreNone) {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    for (const std::size_t at : {kFrequencyAt, kReceiverAt, kSourceLeastAt, kSourceMostAt, kSeaLeastAt, kSeaMostAt, kStepAt})
      EXPECT_TRUE(is(complaint_after([=](Bytes& bytes) { put(bytes, at, none); }), PolicyFault::kOutOfRange, "GRID")) << at << ' ' << none;
    for (const std::size_t at : {kDeepPriorAt, kDeepSeaAt, kShelfPriorAt})
      EXPECT_TRUE(is(complaint_after([=](Bytes& bytes) { put(bytes, at, static_cast<float>(none)); }), PolicyFault::kOutOfRange, "OCNS"))
          << at << ' ' << none;
  }
}

}  // namespace
}  // namespace earshot::policy::in_tables
