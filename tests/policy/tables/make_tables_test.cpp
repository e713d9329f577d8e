#include "policy/tables/make_tables.hpp"
#include "policy/tables/signed_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/trust/signed_bytes.hpp"

namespace earshot::tables {
namespace {

constexpr CurvePlan kPlan{.vehicle_depth = Meters{120.0}, .range_step = Meters{250.0}, .range_count = 3, .bearings = 1};

OceanCurve curve(const std::string& name, double weight, double sea_depth_m, std::vector<double> snr_db) {
  return {.name = name,
          .detail = "",
          .weight = weight,
          .sea_depth = Meters{sea_depth_m},
          .source_depth = Meters{sea_depth_m / 10.0},
          .snr_db = std::move(snr_db)};
}

const std::vector<OceanCurve> kTwo{curve("deep", 3.0, 3000.4, {80.0, 10.1, -3.2}), curve("shelf", 1.0, 200.0, {50.0, -100.0, 0.0})};

std::string text(const auto& characters) {
  return {characters.begin(), characters.end()};
}

TEST(MakeTables, HoldsThePlanAndTheCurvesInHalfDecibels) {
  const auto tables = make_tables(kTwo, kTwo, kPlan, Hertz{40.0}, {{"made_by", "hand"}, {"line", "a\nb"}});
  EXPECT_EQ(tables->frequency, Hertz{40.0});
  EXPECT_EQ(tables->receiver_depth, Meters{120.0});
  EXPECT_EQ(tables->source_depth, (policy::DepthRange{Meters{20.0}, Meters{300.0}}));
  EXPECT_EQ(tables->sea_depth, (policy::DepthRange{Meters{200.0}, Meters{3000.0}}));
  EXPECT_EQ(tables->range_step, Meters{250.0});
  EXPECT_EQ(tables->range_count, 3U);
  EXPECT_EQ(text(tables->provenance), "made_by = hand\nline = a\\nb\n");
  ASSERT_EQ(tables->tables.size(), 2U);
  const policy::OceanTable& deep = tables->tables[0];
  EXPECT_EQ(text(deep.name), "deep");
  EXPECT_EQ(deep.prior, 0.75F);
  EXPECT_EQ(deep.sea_depth_m, 3000.0F);
  EXPECT_EQ(deep.snr_half_db[0], 127);
  EXPECT_EQ(deep.snr_half_db[1], 20);
  EXPECT_EQ(deep.snr_half_db[2], -6);
  EXPECT_EQ(tables->tables[1].prior, 0.25F);
  EXPECT_EQ(tables->tables[1].snr_half_db[1], -128);
}

TEST(MakeTables, SaysTheDepthsOfAllThatWereMergedIntoThem) {
  const auto tables = make_tables({kTwo[1]}, kTwo, kPlan, Hertz{40.0}, {});
  EXPECT_EQ(tables->tables.size(), 1U);
  EXPECT_EQ(tables->sea_depth, (policy::DepthRange{Meters{200.0}, Meters{3000.0}}));
}

TEST(MakeTables, RefusesAnSnrThatIsNoNumberAndMoreThanAVehicleHolds) {
  const std::vector<OceanCurve> none{curve("a", 1.0, 100.0, {1.0, std::nan(""), 2.0})};
  EXPECT_THROW((void)make_tables(none, none, kPlan, Hertz{20.0}, {}), host::BadInput);
  const std::vector<OceanCurve> many(config::kMaxOceanTables + 1, kTwo[0]);
  EXPECT_THROW((void)make_tables(many, many, kPlan, Hertz{20.0}, {}), host::BadInput);
  EXPECT_THROW((void)make_tables(kTwo, kTwo, kPlan, Hertz{20.0}, {{"long", std::string(1020, 'x')}}), host::BadInput);
  CurvePlan plan = kPlan;
  plan.range_count = config::kMaxTableRanges + 1;
  EXPECT_THROW((void)make_tables(kTwo, kTwo, plan, Hertz{20.0}, {}), host::BadInput);
}

TEST(ShortName, LeavesRoomForWhatTellsItFromOthersAndCutsBetweenCharacters) {
  OceanCurve c = curve("twenty-eight letters of name", 1.0, 100.0, {});
  EXPECT_EQ(short_name(c), "twenty-eight letters of name");
  c.detail = " 12 270 deg";
  EXPECT_EQ(short_name(c), "twenty-eight letters  12 270 deg");
  c.name = "twenty-eight letter\u00fc";  // the two bytes of its last letter are 19 and 20
  EXPECT_EQ(short_name(c), "twenty-eight letter\u00fc 12 270 deg");
  c.name = "twenty-eight letters\u00fc";
  EXPECT_EQ(short_name(c), "twenty-eight letters 12 270 deg");
  c.name = c.detail = "";
  EXPECT_EQ(short_name(c), "unnamed");
}

TEST(ShortName, KeepsTheShortEndThatTellsVariantsOfAnOceanApart) {
  OceanCurve c = curve("Munk profile over a flat floor: sand", 1.0, 100.0, {});
  EXPECT_EQ(short_name(c), "Munk profile over a flat f: sand");
  c.detail = " 2 90 deg";  // 9 bytes and ": sand" are 15
  EXPECT_EQ(short_name(c), "Munk profile over: sand 2 90 deg");
  c.name = "bank_005: 337 m of winter water over";  // what stands behind the colon is most of it
  c.detail = "";
  EXPECT_EQ(short_name(c), "bank_005: 337 m of winter water ");
  c.name = "twenty: letters";
  EXPECT_EQ(short_name(c), "twenty: letters") << "nothing is cut";
}

TEST(SignTables, MakesBytesThatAVehicleReadsAndThatTheKeySigned) {
  const host::SecretKey key = host::make_key();
  const std::vector<std::uint8_t> bytes = sign(*make_tables(kTwo, kTwo, kPlan, Hertz{40.0}, {{"a", "b"}}), key);
  EXPECT_EQ(host::tables_from(bytes, "a.tables")->tables.size(), 2U);
  EXPECT_TRUE(host::is_signed_at_end(bytes, host::public_key_of(key)));
}

TEST(SignTables, RefusesWhatAVehicleWould) {
  const auto tables = make_tables(kTwo, kTwo, kPlan, Hertz{40.0}, {});
  tables->frequency = Hertz{0.0};
  EXPECT_THROW((void)sign(*tables, host::make_key()), host::BadInput);
  const std::vector<OceanCurve> named{curve("\xff", 1.0, 100.0, {1.0, 2.0, 3.0})};
  EXPECT_THROW((void)sign(*make_tables(named, named, kPlan, Hertz{40.0}, {}), host::make_key()), host::BadInput);
}

}  // namespace
}  // namespace earshot::tables
