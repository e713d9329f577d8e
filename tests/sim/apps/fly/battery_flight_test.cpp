// Flights of a vehicle whose battery is simulated: the programs themselves, over real LCM and real DDS.

#include <cmath>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

class BatteryFlight : public Flight {
 protected:
  /// Of 25 steps of a kilometre.
  void write_mission(const std::string& tables) {
    shorten_to(25);
    std::ofstream(mission_, std::ios::app) << tables;
  }
  [[nodiscard]] std::vector<messages::VehicleStatus> told(const std::string& out) const {
    std::vector<messages::VehicleStatus> told;
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    messages::Input input;
    for (host::JournalRecord record; reader.next(record);) {
      if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
      if (const auto* status = std::get_if<messages::VehicleStatus>(&input.value)) told.push_back(*status);
    }
    return told;
  }

  static constexpr const char* kTables =
      "\n[vehicle]\nbattery_percent_per_km = 2.0\n\n[[rule]]\nwhen = \"battery_percent\"\nbelow = 30.0\nthen = \"abort\"\n";
};

TEST_F(BatteryFlight, GivenABatteryThatRunsLowTheRuleEndsTheSearchThereAndTheSameSeedDoesTheSameByteForByte) {
  write_mission(kTables);
  for (const char* out : {"first", "second"}) {
    const auto flight = fly(out, {"--seed", "7", "--battery-percent", "50"});
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  EXPECT_TRUE(support::read_text(folder_ / "first/journal.lcmlog") == support::read_text(folder_ / "second/journal.lcmlog"));
  const nlohmann::json s = summary("first");
  EXPECT_EQ(s.at("end_reason"), "safety_rule");
  EXPECT_NEAR(s.at("distance_m").get<double>(), 10'000.0, 20.0) << "20 % at 2 % a kilometre, and some ticks of 2 m";
  EXPECT_NEAR(s.at("battery_percent").get<double>(), 30.0, 0.1);
  const nlohmann::json& rule = s.at("ended_by");
  EXPECT_EQ(rule.at("condition"), "battery_percent");
  EXPECT_EQ(rule.at("limit"), 30.0);
  EXPECT_EQ(rule.at("response"), "abort");
  EXPECT_NEAR(rule.at("value").get<double>(), 29.998, 0.003) << "a tick is 4 thousandths of a percent";
  const std::string said = support::read_text(folder_ / "first.txt");
  EXPECT_TRUE(said.starts_with("Source not found in ")) << said;
  EXPECT_NE(said.find(": safety rule 14, battery_percent: 29.99"), std::string::npos) << said;
  EXPECT_NE(said.find("\n  battery     30.0 % left\n"), std::string::npos) << said;
  const std::vector<messages::VehicleStatus> told = this->told("first");
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().battery_percent, 50.0);
  EXPECT_TRUE(std::isnan(told.front().altitude.value)) << "nothing else is known";
  EXPECT_TRUE(board::replay(folder_ / "first/journal.lcmlog").is_same());
}

TEST_F(BatteryFlight, GivenNoneIsAskedForTheVehicleTellsNoStatus) {
  write_mission(kTables);
  const auto flight = fly("out", {"--seed", "7"});
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  EXPECT_TRUE(told("out").empty());
  EXPECT_EQ(summary("out").at("end_reason"), "steps_used_up");
  EXPECT_FALSE(summary("out").contains("battery_percent"));
  EXPECT_TRUE(summary("out").at("ended_by").is_null());
}

TEST_F(BatteryFlight, GivenAMissionThatDoesNotSayWhatAKilometreTakesOneLineSaysSoAndNothingIsWritten) {
  const auto flight = fly("out", {"--battery-percent", "50"});
  EXPECT_EQ(flight->wait(20s), 2);
  EXPECT_TRUE(support::lines_tell(flight->output(), {{"--battery-percent", mission_.string(), "vehicle.battery_percent_per_km", "not", "it",
                                                      "--battery-percent", "firmware/boards/linux/missions/fenced_search.toml"}}));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace earshot
