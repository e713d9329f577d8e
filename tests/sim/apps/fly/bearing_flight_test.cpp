// Flights with an array that hears from where the source calls: the programs themselves, over real LCM and real DDS.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

class BearingFlight : public Flight {
 protected:
  void SetUp() override {
    Flight::SetUp();
    shorten_to(25);
  }

  /// The ocean that ships, with an array in it.
  [[nodiscard]] fs::path environment(const std::string& conditions) const {
    const fs::path path = folder_ / "array.toml";
    std::ofstream(path) << support::read_text(kEnvironment) << "\n[conditions]\n" << conditions;
    return path;
  }

  struct Journal {
    std::vector<messages::BearingMeasurement> bearings;
    std::vector<std::optional<messages::Bearing>> decided_by;
    messages::Health health;
    std::size_t ticks = 0;
  };
  [[nodiscard]] Journal journal_of(const std::string& out) const {
    Journal journal;
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    for (host::JournalRecord record; reader.next(record);) {
      messages::Input input;
      messages::Decision decision;
      if (wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk) {
        if (const auto* bearing = std::get_if<messages::BearingMeasurement>(&input.value)) journal.bearings.push_back(*bearing);
        if (std::holds_alternative<messages::SnrMeasurement>(input.value)) ++journal.ticks;
      } else if (record.channel == wire::kDecisionChannel && wire::decode(record.data, decision) == Status::kOk) {
        journal.decided_by.push_back(decision.bearing);
      } else if (record.channel == wire::kHealthChannel) {
        (void)wire::decode(record.data, journal.health);
      }
    }
    return journal;
  }
};

TEST_F(BearingFlight, GivenAnArrayEveryTurnAndDecisionHasItsBearingAndTheSameSeedFliesTheSameWayByteForByte) {
  const fs::path array = environment("bearing_deg = 10.0\nbearing_ambiguous = true\n");
  for (const char* out : {"first", "second"}) {
    const auto flight = fly(out, {"--seed", "7"}, array);
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  for (const char* file : {"track.csv", "journal.lcmlog"})
    EXPECT_TRUE(support::read_text(folder_ / "first" / file) == support::read_text(folder_ / "second" / file)) << file;
  const Journal journal = journal_of("first");
  EXPECT_GT(journal.ticks, 25 * 400U);  // of a step of 500 s; at the edge one is shortened
  EXPECT_EQ(journal.bearings.size(), journal.ticks);
  for (const messages::BearingMeasurement& b : journal.bearings) {
    ASSERT_TRUE(b.bearing.mirror_axis);
    EXPECT_NEAR(b.bearing.deviation.value, std::numbers::pi / 18.0, 1e-15);
  }
  EXPECT_FALSE(journal.decided_by.empty());
  for (const auto& bearing : journal.decided_by) EXPECT_TRUE(bearing);
  EXPECT_EQ(journal.health.counters.bearings_refused, 0U);
  EXPECT_EQ(journal.health.counters.bearings_of_others, 0U);
}

TEST_F(BearingFlight, GivenItsJournalAloneTheRuntimeGivesEveryByteAgain) {
  const auto flight = fly("out", {"--seed", "7"}, environment("bearing_deg = 10.0\n"));
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  const board::ReplayResult replayed = board::replay(folder_ / "out/journal.lcmlog");
  EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
  EXPECT_GT(replayed.decisions, 0);
}

TEST_F(BearingFlight, GivenNoArrayTheFlightIsWhatItWasAndItsJournalHoldsNoBearing) {
  const auto flight = fly("out", {"--seed", "7"});
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  const Journal journal = journal_of("out");
  EXPECT_TRUE(journal.bearings.empty());
  EXPECT_TRUE(std::ranges::none_of(journal.decided_by, [](const auto& bearing) { return bearing.has_value(); }));
}

TEST_F(BearingFlight, GivenAMissionWhoseSnrComesOverCanOneLineSaysThatNoBearingCouldAndNothingIsWritten) {
  const fs::path array = environment("bearing_deg = 10.0\n");
  support::Process simulator(kBin / "earshot-sim",
                             {"--environment", array, "--mission", kMission, "--out", folder_ / "out", "--bus", "can"},
                             folder_ / "refused.txt");
  EXPECT_EQ(simulator.wait(10s), 2);
  EXPECT_TRUE(support::lines_tell(
      simulator.output(), {{array.string(), "conditions.bearing_deg", "LCM", "CAN", "none", "no LCM", kMission.string(), "role", "snr"}}));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

/// A flight's files take the place of an earlier one's, by their names alone.
TEST_F(BearingFlight, GivenAnOceanOrAMissionThatBearsTheNameOfAFileOfTheFlightNothingFliesAndItStays) {
  const fs::path out = folder_ / "out";
  fs::create_directories(out);
  std::ofstream(out / "summary.json") << "{}\n";  // an earlier flight's folder
  fs::copy_file(kEnvironment, out / "snr.csv");
  fs::copy_file(kMission, out / "hearing.csv");
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"--environment", out / "snr.csv", "--mission", kMission}, "a file of --environment " + (out / "snr.csv").string()},
      {{"--environment", kEnvironment, "--mission", out / "hearing.csv"}, "--mission " + (out / "hearing.csv").string()}};
  for (const char* program : {"earshot-sim", "earshot-fly"}) {
    for (const auto& [arguments, what] : refused) {
      std::vector<std::string> all = arguments;
      all.insert(all.end(), {"--out", out});
      support::Process flight(kBin / program, all, folder_ / "refused.txt");
      EXPECT_EQ(flight.wait(10s), 2);
      EXPECT_NE(flight.output().find(what + ", a file of --out "), std::string::npos) << flight.output();
      EXPECT_TRUE(support::has_line(flight.output(), {"same file", "replace"})) << flight.output();
    }
  }
  EXPECT_EQ(support::read_text(out / "snr.csv"), support::read_text(kEnvironment));
  EXPECT_EQ(support::read_text(out / "hearing.csv"), support::read_text(kMission));
}

}  // namespace
}  // namespace earshot
