#include "policy/report/document/turn_rows.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "sim/search/belief_model.hpp"

namespace earshot::report {
namespace {

constexpr Time at(double s) {
  return {static_cast<std::int64_t>(s * 1e6)};
}
messages::Input input(const decltype(messages::Input::value)& value) {
  messages::Input input;
  input.value = value;
  return input;
}
messages::Navigation fix(double s, double north_m) {
  return {.time = at(s),
          .position = {Meters{north_m}, Meters{20.04}},
          .depth = Meters{299.96},
          .heading = Radians{-1.5707963267948966},
          .speed = MetersPerSecond{2.004}};
}

class TurnRowsTest : public testing::Test {
 protected:
  TurnRowsTest() {
    config::Mission mission;
    mission.navigation_timeout = Duration::seconds(5);
    mission.snr_timeout = Duration::seconds(10);
    rows_.take(mission);
  }
  nlohmann::ordered_json column(const char* name) { return rows_.strips(0, 100).at(name); }
  TurnRows rows_{at(1000)};
};

TEST_F(TurnRowsTest, GivesWhatCameInBeforeTheTurnWasOver) {
  rows_.take(input(fix(1001, 12.34)));
  rows_.take(input(messages::SnrMeasurement{.time = at(1001), .snr = Decibels{-3.456}, .too_faint = true}));
  rows_.take(input(messages::VehicleStatus{.time = at(1001), .battery_percent = 81.26}));
  rows_.take(messages::Setpoint{
      .heading = Radians{3.141592653589793}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {Meters{1000}, Meters{-50}}});
  rows_.take(at(1001.54), messages::Health{});
  EXPECT_EQ(rows_.strips(0, 100).dump(),
            R"({"time_s":[1.5],"north_m":[12.3],"east_m":[20],"depth_m":[300],"heading_deg":[270],"speed_mps":[2],"depth_set_m":[300],)"
            R"("heading_set_deg":[180],"speed_set_mps":[2],"waypoint_north_m":[1000],"waypoint_east_m":[-50],"snr_db":[-3.46],)"
            R"("snr_too_faint":[true],"expected_snr_db":[null],"mismatch_bits":[null],"battery_percent":[81.3],"turn_time_ms":[null]})");
}

TEST_F(TurnRowsTest, HoldsWhatCameInUntilItIsTooOldAndASetPointForItsTurnAlone) {
  rows_.take(input(fix(1001, 12.0)));
  rows_.take(input(messages::SnrMeasurement{.time = at(1001), .snr = Decibels{7.0}}));
  messages::Setpoint deep;
  deep.depth = Meters{300};
  rows_.take(deep);
  for (const double s : {1002.0, 1006.0, 1007.0, 1012.0}) rows_.take(at(s), messages::Health{});
  EXPECT_EQ(column("north_m").dump(), "[12,12,null,null]");
  EXPECT_EQ(column("snr_db").dump(), "[7,7,7,null]");
  EXPECT_EQ(column("snr_too_faint").dump(), "[false,false,false,null]");
  EXPECT_EQ(column("depth_set_m").dump(), "[300,null,null,null]");
}

TEST_F(TurnRowsTest, LeavesOutWhatCannotBe) {
  rows_.take(input(fix(1001, 1e12)));
  rows_.take(input(messages::SnrMeasurement{.time = at(1001), .snr = Decibels{1e9}}));
  rows_.take(at(1001), messages::Health{});
  EXPECT_EQ(column("north_m").dump(), "[null]");
  EXPECT_EQ(column("snr_db").dump(), "[null]");
}

TEST_F(TurnRowsTest, ThinsManyTurnsEvenlyAndKeepsTheLast) {
  for (int i = 0; i < 10; ++i) rows_.take(at(1000 + i), messages::Health{});
  EXPECT_EQ(rows_.strips(0, 10).at("time_s").dump(), "[0,1,2,3,4,5,6,7,8,9]");
  EXPECT_EQ(rows_.strips(0, 4).at("time_s").dump(), "[0,3,6,9]");
  EXPECT_EQ(rows_.strips(0, 5).at("time_s").dump(), "[1,3,5,7,9]");
  EXPECT_EQ(rows_.strips(8, 100).at("time_s").dump(), "[8,9]") << "those that are new";
  EXPECT_EQ(rows_.strips(10, 100).at("time_s").dump(), "[]");
}

/// A source that is certain to lie 500 m north and east of a corner; heard with 20 dB there, and 20 dB less a kilometre from it.
std::shared_ptr<const Expectation> certain_source(NorthEast corner) {
  const policy::BeliefModel model = search::belief_model(search::SearchSettings{});
  const auto tables = std::make_unique<policy::OceanTables>();
  tables->range_step = Meters{1'000.0};
  tables->range_count = 2;
  policy::OceanTable ocean;
  ocean.prior = 1.0F;
  ocean.snr_half_db[0] = policy::to_half_db(20.0);
  (void)tables->tables.push_back(ocean);
  const auto belief = std::make_unique<policy::OceanBelief>();
  belief->start(model, *tables);
  explain::BelievedPlace place;
  place.area_size = {Meters{1'000.0}, Meters{1'000.0}};
  place.cells_north = place.cells_east = 1;
  place.probability = {1.0};
  return std::make_shared<Expectation>(corner, place, explain::ExpectedSound(*belief, *tables));
}

TEST_F(TurnRowsTest, ExpectsWhatTheLastDecisionBelievesAtTheVehiclesPlace) {
  rows_.take(input(fix(1001, 850.0)));
  rows_.take(at(1001), messages::Health{});
  rows_.expect(certain_source({Meters{100.0}, Meters{-479.96}}), true);  // 250 m south of the vehicle, which is 20.04 m east
  messages::Health health;
  health.mismatch_bits = -2.345F;
  rows_.take(at(1002), health);
  rows_.expect(nullptr, true);
  rows_.take(at(1003), health);
  EXPECT_EQ(column("expected_snr_db").dump(), "[null,15,null]");
  EXPECT_EQ(column("mismatch_bits").dump(), "[null,-2.35,-2.35]");
}

}  // namespace
}  // namespace earshot::report
