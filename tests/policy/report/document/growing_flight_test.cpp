#include "policy/report/document/growing_flight.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "policy/report/document/flight_reading.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

using messages::EndReason;
using messages::MissionState;
using nlohmann::ordered_json;

constexpr NorthEast kSouthWest{Meters{1'000}, Meters{2'000}};  // of SeaJournal's area

/// What somebody has who was given a flight, once this news has come.
void follow(const ordered_json& changes, ordered_json& flight) {
  for (const auto& [name, value] : changes.items()) {
    if (name == "decisions" || name == "events") {
      for (const ordered_json& row : value) flight[name].push_back(row);
    } else if (name == "strips") {
      for (auto column = value.begin(); column != value.end(); ++column)
        for (const ordered_json& cell : *column) flight[name][column.key()].push_back(cell);
    } else {
      flight[name] = value;
    }
  }
}

class GrowingFlightTest : public testing::Test {
 protected:
  /// Its policy and its tables, as earshotd writes them into its journal.
  void put_files(SeaJournal& journal) const {
    journal.file(0, wire::kPolicyChannel, support::signed_bytes(*policy_));
    journal.file(0, wire::kTablesChannel, support::signed_bytes(explain::falling_ocean()));
  }
  void search(SeaJournal& journal, double began_s, const std::vector<explain::RecordedDecision>& decisions) const {
    for (const explain::RecordedDecision& decision : decisions) {
      const double s = began_s + decision.time_s();
      journal.fix(s, decision.position.north.value, decision.position.east.value);
      journal.snr(s, decision.snr.value, decision.too_faint);
      journal.decision(s, decision);
      journal.health(s, decision.step, -1.0F, false, false);
    }
  }
  [[nodiscard]] std::vector<explain::RecordedDecision> flown(std::size_t decisions) const {
    return explain::flown(*policy_, decisions, kSouthWest);
  }
  [[nodiscard]] ordered_json whole() const { return read_to_its_end(surroundings_of(path_))->whole(); }
  /// For each decision whether it is explained: "110".
  static std::string explained(const ordered_json& flight) {
    std::string all;
    for (const ordered_json& decision : flight.at("decisions")) {
      EXPECT_EQ(decision.at("reasons").empty(), decision.at("belief").is_null());
      all += decision.at("reasons").empty() ? '0' : '1';
    }
    return all;
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / kJournalName;
  const std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(GrowingFlightTest, GrowsEntryByEntryToWhatItIsAsAWhole) {
  {
    SeaJournal journal(path_);
    put_files(journal);
    journal.order(1, messages::Order::kStart);
    journal.acknowledge(1, messages::Order::kStart, messages::CommandOutcome::kObeyed);
    search(journal, 10, flown(3));
    journal.state(2'000, MissionState::kDone, EndReason::kStepsUsedUp, 3);
    journal.end(messages::Ending::kMissionOver);
  }
  journal::RecordSource source(path_);
  GrowingFlight flight(surroundings_of(path_));
  Sent sent;
  ordered_json held;
  const auto catch_up = [&] {
    follow(flight.changes(sent), held);
    EXPECT_EQ(flight.changes(sent).dump(), "{}") << "it has been given everything";
  };
  while (const std::optional<journal::Entry> entry = source.next()) {
    flight.take(*entry);
    catch_up();
  }
  EXPECT_TRUE(flight.is_over());
  flight.end(source);
  catch_up();
  const ordered_json whole = flight.whole();
  for (const auto& [name, value] : whole.items()) EXPECT_EQ(held.at(name), value) << name;
  EXPECT_EQ(held.size(), whole.size());
  EXPECT_EQ(whole.at("strips").at("time_s").dump(), "[10,510,1010,2000]");
  EXPECT_EQ(explained(whole), "111");
  Sent all = flight.all_sent();
  EXPECT_EQ(flight.changes(all).dump(), "{}");
}

TEST_F(GrowingFlightTest, WhileItIsWrittenMissesNoEndAndKnowsNoVerdict) {
  {
    SeaJournal journal(path_);
    put_files(journal);
    search(journal, 10, flown(1));
    journal.end(messages::Ending::kStopped);
  }
  GrowingFlight flight(surroundings_of(path_));
  journal::for_each_record(path_, [&flight](const journal::Record& record) {
    if (!std::holds_alternative<messages::ClosingRecord>(record.content)) flight.take(record);
  });
  const ordered_json whole = flight.whole();
  EXPECT_EQ(whole.at("is_over"), false);
  EXPECT_EQ(whole.at("shortcomings").dump(), "[]");
  EXPECT_EQ(whole.at("verdict").dump(), R"({"text":"Searching: 0 steps taken","found":null})");
}

TEST_F(GrowingFlightTest, BeforeItsFirstRecordWaitsForItsMission) {
  GrowingFlight flight({.name = "a", .journal = {}, .files = {}, .recording = {}});
  const ordered_json whole = flight.whole();
  EXPECT_EQ(whole.at("verdict").at("text"), "Waiting for its mission");
  for (const char* part : {"mission", "health", "sound", "truth", "began_utc", "open_at_step"})
    EXPECT_TRUE(whole.at(part).is_null()) << part;
}

TEST_F(GrowingFlightTest, ExplainsEverySearchOfAJournalUpToAGap) {
  {
    SeaJournal journal(path_);
    put_files(journal);
    std::vector<explain::RecordedDecision> gapped = flown(4);
    gapped.erase(gapped.begin() + 2);
    search(journal, 10, gapped);
    search(journal, 3'000, flown(2));
    journal.end(messages::Ending::kStopped);
  }
  EXPECT_EQ(explained(whole()), "11011");
  EXPECT_TRUE(support::tells(whole().at("shortcomings").at(0).get<std::string>(), {"Not explained", "step 2", "missing"}));
}

TEST_F(GrowingFlightTest, DoesNotExplainWhatAnotherPolicyDecided) {
  {
    SeaJournal journal(path_);
    put_files(journal);
    search(journal, 10, flown(2));
    journal.end(messages::Ending::kStopped);
  }
  support::write_bytes(folder_ / "other.policy", support::signed_bytes(*explain::belief_policy(2)));
  FlightSurroundings around = surroundings_of(path_);
  around.recording.policy = folder_ / "other.policy";
  const auto flight = read_to_its_end(std::move(around));
  EXPECT_EQ(explained(flight->whole()), "00");
  EXPECT_TRUE(support::tells(flight->unexplained(), {"step 0", "another policy", "other.policy", "other logits"}));
}

TEST_F(GrowingFlightTest, TakesThePolicyBesideAJournalThatHoldsNoneAndComplainsOfOneThatIsNoPolicy) {
  support::write_bytes(folder_ / "journal.policy", support::signed_bytes(*policy_));
  support::write_bytes(folder_ / "journal.tables", support::signed_bytes(explain::falling_ocean()));
  {
    SeaJournal journal(path_);
    search(journal, 10, flown(2));
    journal.end(messages::Ending::kStopped);
  }
  EXPECT_EQ(explained(whole()), "11");
  std::filesystem::resize_file(folder_ / "journal.policy", 100);
  EXPECT_EQ(explained(whole()), "00");
  EXPECT_TRUE(support::tells(read_to_its_end(surroundings_of(path_))->unexplained(), {"journal.policy"}));
}

TEST_F(GrowingFlightTest, OfAPolicyWithoutABeliefKnowsNothingToExplainAtSea) {
  const auto blind = explain::place_policy(1);
  support::write_bytes(folder_ / "journal.policy", support::signed_bytes(*blind));
  {
    SeaJournal journal(path_);
    search(journal, 10, explain::flown(*blind, 1, kSouthWest));
    journal.end(messages::Ending::kStopped);
  }
  EXPECT_EQ(explained(whole()), "0");
  EXPECT_EQ(read_to_its_end(surroundings_of(path_))->unexplained(), "") << "no file is at fault";
  EXPECT_TRUE(support::tells(whole().at("shortcomings").at(0).get<std::string>(), {"holds no belief", "snr.csv"}));
  const support::TemporaryFolder simulated;
  write_flight(simulated, *blind, explain::flown(*blind, 2, {}), {});
  const ordered_json flight = read_to_its_end(surroundings_of(simulated))->whole();
  EXPECT_EQ(explained(flight), "11");
  EXPECT_EQ(flight.at("decisions").at(0).at("belief").at("is_the_policys"), false);
}

TEST_F(GrowingFlightTest, ListsWhatHappenedByItsKind) {
  {
    SeaJournal journal(path_);
    journal.order(1, messages::Order::kStart);
    journal.acknowledge(2, messages::Order::kStart, messages::CommandOutcome::kObeyed);
    journal.state(3, MissionState::kSearch, EndReason::kNone, 0);
    journal.port(4, {.port = 2, .link_up = false});
    journal.rule(5, {.time = {},
                     .rule = 12,
                     .condition = config::Condition::kLeak,
                     .response = config::Response::kWarn,
                     .begins = true,
                     .measure = 1,
                     .limit = 0});
    journal.decision(6, {});
    journal.resume(43);
    journal.end(messages::Ending::kStopped);
  }
  std::vector<std::string> kinds;
  const ordered_json events = whole().at("events");
  for (const ordered_json& event : events) kinds.push_back(event.at("time_s").dump() + " " + event.at("kind").get<std::string>());
  const std::vector<std::string> in_order{"0 journal", "1 order", "2 answer", "3 state", "4 link", "5 rule", "6 decision", "43 journal"};
  ASSERT_GE(kinds.size(), in_order.size());
  std::size_t at = 0;
  for (const std::string& kind : kinds) at += at < in_order.size() && kind == in_order[at] ? 1 : 0;
  EXPECT_EQ(at, in_order.size()) << events.dump(1);
  bool has_silence = false;
  for (const ordered_json& event : events)
    has_silence |= support::tells(event.at("text").get<std::string>(), {"--resume", "37 s", "after"});
  EXPECT_TRUE(has_silence) << events.dump(1);
}

TEST_F(GrowingFlightTest, GivesMissionAndHealthAsTheVehicleHasThem) {
  {
    SeaJournal journal(path_);
    journal.battery(1, 50.0);
    messages::Setpoint deep;
    deep.depth = Meters{300};
    journal.setpoint(2, deep);
    journal.state(3, MissionState::kSearch, EndReason::kNone, 0);
    journal.end(messages::Ending::kStopped);
  }
  const ordered_json flight = whole();
  EXPECT_EQ(flight.at("mission").at("area").dump(), R"({"south_m":1000,"west_m":2000,"north_m":26000,"east_m":27000})");
  EXPECT_EQ(flight.at("mission").at("detection_threshold_db"), 10);
  EXPECT_EQ(flight.at("mission").at("max_steps"), 100);
  EXPECT_TRUE(flight.at("mission").at("origin").is_null());
  EXPECT_EQ(flight.at("mission").at("fence_halt").dump(), "[]");
  const ordered_json& health = flight.at("health");
  EXPECT_EQ(health.at("state"), "SEARCH");
  EXPECT_EQ(health.at("end_reason"), "under way");
  EXPECT_EQ(health.at("response"), "warn");
  EXPECT_EQ(health.at("counters").at(1).dump(), R"({"name":"SNR measurements refused","value":4})");
  EXPECT_EQ(flight.at("strips").at("battery_percent").dump(), "[50]");
  EXPECT_EQ(flight.at("strips").at("depth_set_m").dump(), "[300]");
}

TEST_F(GrowingFlightTest, KnowsTheTruthOfASimulationAlone) {
  const support::TemporaryFolder simulated;
  write_flight(simulated, *policy_, explain::flown(*policy_, 1, {}), {});
  FlightSurroundings around = surroundings_of(simulated);
  around.open_at_step = 0;
  const ordered_json flight = read_to_its_end(std::move(around))->whole();
  const ordered_json& truth = flight.at("truth");
  EXPECT_EQ(truth.at("source").dump(), R"({"north_m":12000,"east_m":15000})");
  ASSERT_EQ(truth.at("snr_of_range").at("range_m").size(), 37U);
  EXPECT_EQ(truth.at("snr_of_range").at("range_m").at(3), 3000);
  EXPECT_EQ(truth.at("snr_of_range").at("snr_db").at(3), 37);
  EXPECT_EQ(flight.at("name"), simulated.path().filename().string());
  EXPECT_EQ(flight.at("open_at_step"), 0);
}

}  // namespace
}  // namespace earshot::report
