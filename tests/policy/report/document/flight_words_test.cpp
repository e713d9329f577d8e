#include "policy/report/document/flight_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>

#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "policy/report/document/flight_reading.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;
using messages::EndReason;
using messages::MissionState;
using nlohmann::ordered_json;

/// Whether one of the texts names all facts in their order.
testing::AssertionResult one_tells(const ordered_json& texts, support::Facts facts) {
  for (const ordered_json& text : texts) {
    if (support::tells(text.get<std::string>(), facts)) return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << texts.dump(1);
}

std::string value_of(const ordered_json& flight, const std::string& fact, const char* what = "value") {
  for (const ordered_json& one : flight.at("facts")) {
    if (one.at("name") == fact) return one.at(what);
  }
  return "-";
}

/// A simulated flight of three decisions.
class SimulatedWords : public testing::Test {
 protected:
  SimulatedWords() {
    write_flight(folder_, *policy_, explain::flown(*policy_, 3, {}), {});
    summary_ = nlohmann::json::parse(std::ifstream(folder_ / "summary.json"));
  }
  [[nodiscard]] ordered_json flight() const {
    std::ofstream(folder_ / "summary.json") << summary_;
    return read_to_its_end(surroundings_of(folder_))->whole();
  }
  [[nodiscard]] std::string verdict() const { return flight().at("verdict").at("text"); }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
  nlohmann::json summary_;
};

TEST_F(SimulatedWords, CountStepsOnceAndStateThatTheSourceCutTheLastOneShort) {
  summary_["found"] = true;
  summary_["steps"] = 16;
  summary_["whole_steps"] = 15;
  EXPECT_TRUE(support::tells(verdict(), {"found", "after 16 steps"}));
  EXPECT_EQ(flight().at("verdict").at("found"), true);
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"last step", "cut short"}));
  summary_["whole_steps"] = 16;
  EXPECT_FALSE(one_tells(flight().at("sentences"), {"cut short"}));
}

TEST_F(SimulatedWords, StateThatTheMissionEndedWithinTheStepOfTheLastDecision) {
  EXPECT_FALSE(one_tells(flight().at("sentences"), {"within the step"})) << "3 steps, 3 decisions";
  summary_["steps"] = 2;
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"within the step of the last of 3 decisions"}));
}

TEST_F(SimulatedWords, GiveTheModelMismatchTheSweepAndTheWrongDeclaration) {
  EXPECT_FALSE(one_tells(flight().at("sentences"), {"6.75"})) << "a summary of an earlier version";
  summary_["surprise_bits"] = 13.25;
  summary_["surprised_from_step"] = 9;
  summary_["swept_from_step"] = 11;
  summary_["max_steps"] = 100;
  EXPECT_TRUE(support::tells(verdict(), {"not found", "3 steps", "a test"}));
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"13.2 bits", "6.75", "step 11", "100", "swept"}));
  summary_["end_reason"] = "found";
  summary_["step_length_m"] = 1'000.0;
  summary_["declared_found"] = {{"step", 3}, {"range_m", 1'020.6}};
  EXPECT_TRUE(support::tells(verdict(), {"not found", "3 steps", "step 3", "wrongly", "1021 m"}));
  EXPECT_EQ(flight().at("verdict").at("found"), false);
}

TEST_F(SimulatedWords, NeverDenyASourceThatTheVehicleRightlyDeclaredFound) {
  summary_["step_length_m"] = 1'000.0;
  summary_["declared_found"] = {{"step", 2}, {"range_m", 640.0}};
  EXPECT_TRUE(support::tells(verdict(), {"declared", "step 2", "640 m"}));
  EXPECT_EQ(flight().at("verdict").at("found"), true);
  EXPECT_EQ(value_of(flight(), "found"), "yes");
  EXPECT_EQ(value_of(flight(), "declared"), "at step 2");
}

TEST_F(SimulatedWords, StateThatItIsASimulationWhoseTruthTheVehicleNeverSaw) {
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"This flight is a simulation.", "never saw", "source"}));
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"simulator", "START", "COMPLETE", "within a step length"}));
  EXPECT_EQ(flight().at("is_simulated"), true);
}

TEST_F(SimulatedWords, GiveFrequencyDepthSpeedPlaceAndDateAndWhatEachResultMeans) {
  EXPECT_EQ(value_of(flight(), "frequency of the source"), "-") << "a summary of an earlier version";
  summary_["source_frequency_hz"] = 20.0;
  summary_["depth_m"] = 300.0;
  summary_["speed_mps"] = 2.0;
  summary_["origin"] = {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}};
  summary_["flown_utc"] = "2026-11-29 18:38:46";
  summary_["battery_percent"] = 29.998;
  const ordered_json whole = flight();
  EXPECT_EQ(value_of(whole, "frequency of the source"), "20.0 Hz");
  EXPECT_EQ(value_of(whole, "depth of the vehicle"), "300 m");
  EXPECT_EQ(value_of(whole, "speed of the vehicle"), "2.0 m/s");
  EXPECT_EQ(value_of(whole, "simulated on"), "2026-11-29 18:38:46 UTC");
  EXPECT_EQ(value_of(whole, "battery left"), "30.0 %");
  EXPECT_EQ(value_of(whole, "time at sea"), "33 min");
  EXPECT_EQ(value_of(whole, "seed"), "1");
  EXPECT_TRUE(support::tells(value_of(whole, "area", "meaning"), {"38.500\u00B0 N", "28.000\u00B0 W"}));
  EXPECT_TRUE(value_of(whole, "detections", "meaning").starts_with("a step that ends with an SNR of 10 dB or more"));
  EXPECT_TRUE(value_of(whole, "found", "meaning").starts_with("the vehicle came within one step length of the source"));
}

TEST_F(SimulatedWords, DoNotClaimOfAPolicyWithoutMeasurementsThatItMeasuredNorThatItCouldDeclare) {
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"It measured the SNR at its own place"}));
  const auto blind = explain::place_policy(1);
  write_flight(folder_, *blind, explain::flown(*blind, 3, {}), {});
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"This flight is a simulation.", "place and steps alone", "uses no measurement"}));
  EXPECT_FALSE(one_tells(flight().at("sentences"), {"It measured the SNR"}));
  EXPECT_EQ(value_of(flight(), "declared"), "-");
}

TEST_F(SimulatedWords, StateOfAFlightThatHeardHowLongItLearntTheNoiseAndWhichOfItsFilesIsMissing) {
  summary_["hearing"] = {{"sound", "synthetic"}, {"search_began_s", 133.0}};
  std::ofstream(folder_ / "hearing.csv") << "time_s,snr_db,too_faint,modelled_snr_db,modelled_too_faint\n1,2,0,3,0\n";
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"For the first 133 s", "noise"}));
  EXPECT_TRUE(one_tells(flight().at("shortcomings"), {"Not there", "spectrogram.csv"}));
  EXPECT_TRUE(flight().at("sound").is_null());
  std::ofstream(folder_ / "spectrogram.csv") << "time_s,5,6\n1,80,81\n";
  EXPECT_EQ(flight().at("sound").at("modelled").dump(), R"({"time_s":[1],"snr_db":[3]})");
}

TEST_F(SimulatedWords, NameTheRuleThatEndedTheFlightAsTheJournalHasIt) {
  fs::remove(folder_ / kJournalName);
  {
    SeaJournal journal(folder_ / kJournalName);
    journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
    journal.rule(600, {.time = {},
                       .rule = 9,
                       .condition = config::Condition::kBattery,
                       .response = config::Response::kAbort,
                       .begins = true,
                       .measure = 29.998,
                       .limit = 30.0});
    journal.state(600, MissionState::kAbort, EndReason::kSafetyRule, 3);
    journal.end(messages::Ending::kMissionOver);
  }
  summary_["end_reason"] = "safety_rule";
  EXPECT_TRUE(support::tells(verdict(), {"not found", "3 steps", "rule 10", "battery_percent", "29.998", "below 30.000", "abort"}));
}

TEST_F(SimulatedWords, OfAFlightWhoseSimulatorWasKilledNameWhatItDidNotWrite) {
  for (const char* name : {"summary.json", "snr.csv"}) fs::remove(folder_ / name);
  const ordered_json whole = read_to_its_end(surroundings_of(folder_))->whole();
  EXPECT_TRUE(one_tells(whole.at("shortcomings"), {"Not there", "summary.json", "snr.csv"}));
  EXPECT_EQ(whole.at("decisions").at(2).at("reasons").empty(), false);
  EXPECT_EQ(whole.at("verdict").at("text"), "A flight without its end");
}

TEST_F(SimulatedWords, NameTheJournalsGapsAndThatItsPolicyIsMissing) {
  fs::remove(folder_ / "journal.policy");
  EXPECT_TRUE(one_tells(flight().at("shortcomings"), {"Not explained", "no policy beside it", "journal.policy"}));
  fs::resize_file(folder_ / kJournalName, fs::file_size(folder_ / kJournalName) - 1);
  EXPECT_TRUE(one_tells(flight().at("shortcomings"), {"journal ends", "no", "record"}));
}

/// A flight at sea.
class SeaWords : public testing::Test {
 protected:
  void fly_until(MissionState state, EndReason reason) const {
    SeaJournal journal(folder_ / kJournalName);
    for (int i = 0; i < 10; ++i) journal.fix(i, 3'000 + 100.0 * i, 4'000);
    journal.snr(5, 12.0);
    journal.snr(6, 50.0, true);
    journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
    messages::Decision detecting;
    detecting.detected = true;
    journal.decision(90, detecting);
    if (state != MissionState::kSearch) journal.state(600, state, reason, 3);
    journal.end(messages::Ending::kStopped);
  }
  [[nodiscard]] ordered_json flight() const { return read_to_its_end(surroundings_of(folder_))->whole(); }
  [[nodiscard]] std::string verdict() const { return flight().at("verdict").at("text"); }

  support::TemporaryFolder folder_;
};

TEST_F(SeaWords, GiveHowAndWhyTheSearchEndedAndWhenTheFlightWas) {
  fly_until(MissionState::kAbort, EndReason::kOperatorAbort);
  const ordered_json whole = flight();
  EXPECT_TRUE(support::tells(verdict(), {"aborted after 3", "steps", messages::to_string(EndReason::kOperatorAbort)}));
  EXPECT_EQ(whole.at("verdict").at("found"), false);
  EXPECT_EQ(whole.at("began_utc"), "2026-11-18T11:06:40Z");
  EXPECT_EQ(whole.at("is_simulated"), false);
  EXPECT_TRUE(one_tells(whole.at("sentences"), {"2026-11-18 11:06:40 UTC"}));
  EXPECT_TRUE(one_tells(whole.at("sentences"), {"earshotd", "stopped", "signal", "ended", "order"}));
  EXPECT_TRUE(one_tells(whole.at("sentences"), {"The journal is whole"}));
  EXPECT_TRUE(one_tells(whole.at("sentences"), {"earshotd of a test"}));
  EXPECT_FALSE(one_tells(whole.at("shortcomings"), {"Not there"})) << "a simulator's files belong to no flight at sea";
}

TEST_F(SeaWords, GiveTheNumbersOfTheSearch) {
  fly_until(MissionState::kDone, EndReason::kStepsUsedUp);
  const ordered_json whole = flight();
  EXPECT_EQ(value_of(whole, "frequency searched for"), "20.0 Hz");
  EXPECT_EQ(value_of(whole, "time in the journal"), "10 min");
  EXPECT_EQ(value_of(whole, "of it searching"), "10 min") << "590 s";
  EXPECT_EQ(value_of(whole, "detections"), "1");
  EXPECT_EQ(value_of(whole, "loudest SNR"), "12.0 dB") << "of the other it is only known that it lies below 50 dB";
  EXPECT_EQ(value_of(whole, "fixes"), "10");
  EXPECT_EQ(value_of(whole, "SNR measurements"), "2");
  EXPECT_TRUE(support::tells(value_of(whole, "refused"), {"fixes 0", "SNR 4", "bearings 2", "3", "commands 0"}));
}

TEST_F(SeaWords, DoNotDenyASourceThatTheVehicleDeclaredFound) {
  fly_until(MissionState::kDone, EndReason::kFound);
  EXPECT_TRUE(support::tells(verdict(), {"ended after 3", "steps", messages::to_string(EndReason::kFound)}));
  EXPECT_EQ(flight().at("verdict").at("found"), true);
}

TEST_F(SeaWords, GiveTheRuleThatEndedTheSearchAndNoneOfThoseThatCameAfter) {
  {
    SeaJournal journal(folder_ / kJournalName);
    journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
    const auto rule = [](std::uint8_t number, config::Response response, double limit) {
      return messages::SafetyEvent{.time = {},
                                   .rule = number,
                                   .condition = config::Condition::kBattery,
                                   .response = response,
                                   .begins = true,
                                   .measure = limit - 0.1,
                                   .limit = limit};
    };
    journal.rule(500, rule(9, config::Response::kWarn, 40.0));
    journal.rule(600, rule(10, config::Response::kAbort, 15.0));
    journal.state(600, MissionState::kAbort, EndReason::kSafetyRule, 3);
    journal.rule(700, rule(11, config::Response::kRelease, 10.0));
    journal.end(messages::Ending::kMissionOver);
  }
  EXPECT_TRUE(support::tells(verdict(), {"aborted after 3", "steps", messages::to_string(EndReason::kSafetyRule), "rule 11",
                                         "battery_percent", "14.9", "below 15.0", "abort"}));
}

TEST_F(SeaWords, GiveTheMismatchThatTheVehicleSweptAndThatItDeclared) {
  {
    SeaJournal journal(folder_ / kJournalName);
    messages::Decision believing;
    believing.belief.emplace();
    journal.decision(10, believing);
    journal.health(10, 0, 1.0F, false, false);
    journal.health(20, 9, 6.75F, false, false);
    journal.health(30, 11, 12.0F, true, false);
    journal.health(40, 34, 11.5F, true, true);
    journal.end(messages::Ending::kStopped);
  }
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"step 9", "SNR", "11.5 bits", "6.75", "step 11", "100", "swept", "tracks"}));
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"vehicle", "declared", "source", "found", "step 34"}));
}

TEST_F(SeaWords, OfASearchThatASignalBrokeOffStateThatNoOperatorAbortedIt) {
  SeaJournal journal(folder_ / kJournalName);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.stop(599);
  journal.state(600, MissionState::kAbort, EndReason::kOperatorAbort, 3);
  journal.end(messages::Ending::kStopped);
  EXPECT_TRUE(support::tells(verdict(), {"aborted after 3", "steps", "stopped"}));
  EXPECT_EQ(verdict().find("an operator aborted it"), std::string::npos);
}

TEST_F(SeaWords, OfAJournalThatEndsInMidSearchStateThatItsEndIsMissing) {
  fly_until(MissionState::kSearch, EndReason::kNone);
  fs::resize_file(folder_ / kJournalName, fs::file_size(folder_ / kJournalName) - (28 + 19 + 47));
  EXPECT_TRUE(support::tells(verdict(), {"journal", "mid-search", "after 0 steps"}));
  EXPECT_TRUE(flight().at("verdict").at("found").is_null());
  EXPECT_TRUE(one_tells(flight().at("shortcomings"), {"The journal's end is missing"}));
}

TEST_F(SeaWords, OfAFlightThatNobodyStartedStateThat) {
  SeaJournal(folder_ / kJournalName).end(messages::Ending::kStopped);
  EXPECT_EQ(verdict(), "A flight without a search: nobody started it");
}

TEST_F(SeaWords, GiveWhatTheSafetyRecordBesideTheJournalHolds) {
  fly_until(MissionState::kSearch, EndReason::kNone);
  EXPECT_FALSE(one_tells(flight().at("sentences"), {"beside the journal"}));
  host::SafetyCopies copies({{.file = folder_ / "journal.safety"}});
  copies.prepare(std::vector<std::uint8_t>{1});
  host::SafetyRecord record;
  record.utc = {1'795'000'000'000'000};
  record.state = MissionState::kAbort;
  record.end_reason = EndReason::kOutage;
  record.is_engaged = true;
  record.max_depth = Meters{350};
  ASSERT_TRUE(copies.write(record, std::chrono::seconds(10)));
  EXPECT_TRUE(one_tells(flight().at("sentences"), {"beside the journal", "2026-11-18 11:06:40 UTC", "ABORT",
                                                   messages::to_string(EndReason::kOutage), "at most 350 m"}));
}

}  // namespace
}  // namespace earshot::report
