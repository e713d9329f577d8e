#include "policy/report/page.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/occurrences.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kClosingBytes = 28 + 19 + 47;  ///< header, channel, journal_end_t: the last record

class PageTest : public testing::Test {
 protected:
  PageTest() {
    std::vector<explain::RecordedDecision> taken = explain::flown(*policy_, 3, {});
    taken[1].overridden = true;
    write_flight(folder_, *policy_, taken, {});
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(PageTest, UnfoldsTheReasonsOfEveryDecision) {
  const FlightExplanation explanation = explain_flight(folder_);
  ASSERT_EQ(explanation.why_not, "");
  const std::string text = page(read_flight(folder_), {.map = "<svg>map</svg>", .history = ""}, explanation);
  EXPECT_EQ(count(text, "<details><summary>why "), 3U);
  EXPECT_EQ(count(text, "The likeliest place is "), 3U);
  EXPECT_EQ(count(text, "complete within 0.001"), 3U);
  EXPECT_EQ(count(text, "<h3>What moved the choice</h3>"), 3U);
  EXPECT_EQ(count(text, "<svg"), 4U) << "the map and a chart for each decision";
  EXPECT_EQ(count(text, "The safety layer moved the way-point"), 1U);
}

TEST_F(PageTest, ShowsTheScoresOfAPolicyWithoutANetworkAndNothingThatMovedItsChoice) {
  FlightExplanation explanation = explain_flight(folder_);
  explanation.accounts[0].draw = policy::ActionDraw::kSampled;
  EXPECT_EQ(count(page(read_flight(folder_), {}, explanation), "Percent: how probable the policy made each direction; bold"), 1U);
  for (explain::DecisionAccount& account : explanation.accounts) {
    account.draw = policy::ActionDraw::kArgmax;
    for (explain::ActionAccount& action : account.actions) action.worth = 1.0;
  }
  const std::string text = page(read_flight(folder_), {}, explanation);
  EXPECT_EQ(count(text, "Percent: the score of each direction, made from its regret, of which the policy takes the highest; bold"), 1U);
  EXPECT_EQ(count(text, "What moved the choice"), 0U);
}

TEST_F(PageTest, ExplainsTheMarkOfAnSnrThatWasTooFaintWhereThereIsOne) {
  Flight flight = read_flight(folder_);
  for (explain::RecordedDecision& decision : flight.journal.decisions) decision.too_faint = false;
  EXPECT_EQ(count(page(flight, {}, {}), "&lt;"), 0U);
  flight.journal.decisions[1].too_faint = true;
  const std::string text = page(flight, {}, {});
  EXPECT_EQ(count(text, "&lt;: too faint to measure, the SNR lies below this"), 1U);
  EXPECT_EQ(count(text, "&lt;"), 2U) << "the legend and the one row";
}

TEST_F(PageTest, NamesEveryCellOfADecisionForANarrowScreen) {
  const std::string text = page(read_flight(folder_), {}, explain_flight(folder_));
  for (const char* name : {"step", "at", "north (km)", "east (km)", "SNR (dB)", "N", "NE", "E", "SE", "S", "SW", "W", "NW"})
    EXPECT_EQ(count(text, std::string("<td data-name=\"") + name + "\""), 3U) << name;
}

TEST_F(PageTest, CountsStepsOnceAndSaysThatTheSourceCutTheLastOneShort) {
  Flight flight = read_flight(folder_);
  flight.summary["found"] = true;
  flight.summary["steps"] = 16;
  flight.summary["whole_steps"] = 15;
  const std::string text = page(flight, {}, {});
  EXPECT_TRUE(support::has_line(text, {"<h1", "found", "after 16 steps"}));
  EXPECT_EQ(count(text, "cut short"), 1U);
  EXPECT_EQ(count(text, "15 steps"), 0U);
  flight.summary["whole_steps"] = 16;
  EXPECT_EQ(count(page(flight, {}, {}), "cut short"), 0U);
}

TEST_F(PageTest, SaysThatTheMissionEndedWithinTheStepOfTheLastDecision) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "within the step"), 0U) << "3 steps, 3 decisions";
  flight.summary["steps"] = 2;
  EXPECT_EQ(count(page(flight, {}, {}), "within the step of the last of 3 decisions"), 1U);
}

TEST_F(PageTest, GivesInItsHeadTheModelMismatchTheSweepAndTheWrongDeclaration) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "mismatch"), 0U) << "a summary of an earlier version";
  flight.summary["surprise_bits"] = 13.25;
  flight.summary["surprised_from_step"] = 9;
  flight.summary["swept_from_step"] = 11;
  flight.summary["max_steps"] = 100;
  const std::string swept = page(flight, {}, {});
  EXPECT_TRUE(support::has_line(swept, {"<h1", "missed", "not found", "3 steps", "a test"}));
  EXPECT_TRUE(support::has_line(swept, {"13.2 bits", "6.75", "step 11", "100", "swept"}));
  flight.summary["end_reason"] = "found";
  flight.summary["step_length_m"] = 1'000.0;
  flight.summary["declared_found"] = {{"step", 3}, {"range_m", 1'020.6}};
  const std::string declared = page(flight, {}, {});
  EXPECT_TRUE(support::has_line(declared, {"<h1", "missed", "not found", "3 steps", "step 3", "wrongly", "1021 m"}));
  EXPECT_EQ(count(declared, "Source found"), 0U);
  flight.summary["end_reason"] = "declared_found";
  EXPECT_EQ(page(flight, {}, {}), declared) << "a summary of an earlier version";
}

TEST_F(PageTest, NeverDeniesASourceThatTheVehicleRightlyDeclaredFound) {
  Flight flight = read_flight(folder_);
  flight.summary["step_length_m"] = 1'000.0;
  flight.summary["declared_found"] = {{"step", 2}, {"range_m", 640.0}};
  const std::string text = page(flight, {}, {});
  EXPECT_TRUE(support::has_line(text, {"<h1", "class=\"found\"", "declared", "step 2", "640 m"}));
  EXPECT_EQ(count(text, "not found"), 0U);
  EXPECT_EQ(count(text, "class=\"missed\""), 0U);
  EXPECT_EQ(count(text, "<dt>found</dt><dd>yes</dd>"), 1U);
}

TEST_F(PageTest, StatesThatItIsASimulationAndThatTheColouredFieldIsTheTruthThatTheVehicleNeverSaw) {
  const std::string text = page(read_flight(folder_), {.map = "<svg>map</svg>", .history = ""}, {});
  EXPECT_EQ(count(text, "This flight is a simulation."), 1U);
  EXPECT_TRUE(support::has_line(text, {"coloured field", "truth", "never saw"}));
}

TEST_F(PageTest, GivesFrequencyDepthSpeedPlaceAndDateAndWhatEachResultMeans) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "<dt>frequency of the source</dt>"), 0U) << "a summary of an earlier version";
  flight.summary["surprise_bits"] = 1.0;
  flight.summary["source_frequency_hz"] = 20.0;
  flight.summary["depth_m"] = 300.0;
  flight.summary["speed_mps"] = 2.0;
  flight.summary["origin"] = {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}};
  flight.summary["flown_utc"] = "2026-11-29 18:38:46";
  const std::string text = page(flight, {}, {});
  EXPECT_TRUE(support::has_line(text, {"frequency of the source</dt>", "<dd>20.0 Hz</dd>"}));
  EXPECT_TRUE(support::has_line(text, {"depth of the vehicle</dt>", "<dd>300 m</dd>"}));
  EXPECT_TRUE(support::has_line(text, {"speed of the vehicle</dt>", "<dd>2.0 m/s</dd>"}));
  EXPECT_TRUE(support::has_line(text, {"38.500\u00B0 N", "28.000\u00B0 W"}));
  EXPECT_EQ(count(text, "<dt>simulated on</dt><dd>2026-11-29 18:38:46 UTC</dd>"), 1U);
  for (const char* meaning : {"0 for each step that ends with a detection", "a step that ends with an SNR of 10 dB or more",
                              "the vehicle came within one step length of the source", "the vehicle's own rule reports"})
    EXPECT_EQ(count(text, std::string("<dd class=\"meaning\">") + meaning), 1U) << meaning;
}

TEST_F(PageTest, DoesNotSayOfAPolicyWithoutMeasurementsThatItMeasuredNorThatItCouldDeclare) {
  const support::TemporaryFolder own;
  const auto policy = explain::place_policy(1);
  write_flight(own, *policy, explain::flown(*policy, 3, {}), {});
  const std::string text = page(read_flight(own), {.map = "<svg>map</svg>", .history = ""}, explain_flight(own));
  EXPECT_TRUE(support::has_line(text, {"This flight is a simulation.", "place and steps alone", "uses no measurement"}));
  EXPECT_EQ(count(text, "It measured the SNR"), 0U);
  EXPECT_EQ(count(text, "It measured an SNR"), 0U);
  EXPECT_EQ(count(text, "<dt>declared</dt>"), 0U);
  EXPECT_EQ(count(page(read_flight(folder_), {}, explain_flight(folder_)), "It measured the SNR at its own place"), 1U);
}

TEST_F(PageTest, StatesThatARowIsTheDecisionThatBeginsAStepAndThatTheLastStepsEndHasNone) {
  const std::string text = page(read_flight(folder_), {}, {});
  EXPECT_TRUE(support::has_line(text, {"A row is the decision", "begins a step", "step 0", "SNR was measured before"}));
  EXPECT_TRUE(support::has_line(text, {"end of the last step", "no row"}));
}

TEST_F(PageTest, RefusesASummaryWhoseOriginIsNoPlace) {
  nlohmann::json summary = read_flight(folder_).summary;
  summary["origin"] = {{"latitude_deg", "north"}, {"longitude_deg", 3.0}};
  std::ofstream(folder_ / "summary.json") << summary;
  try {
    (void)read_flight(folder_);
    FAIL() << "was taken";
  } catch (const host::BadInput& e) {
    EXPECT_EQ(e.what(), fs::path(folder_ / "summary.json").string() + ": origin: must be latitude_deg, longitude_deg");
  }
}

TEST_F(PageTest, CallsASweepASweepAndNotAChoiceOfThePolicy) {
  Flight flight = read_flight(folder_);
  flight.journal.decisions[2].sweeping = true;
  FlightExplanation explanation = explain_flight(folder_);
  explanation.accounts[2].decision.sweeping = true;
  const std::string text = page(flight, {}, explanation);
  EXPECT_EQ(count(text, "<details><summary>why "), 2U);
  EXPECT_EQ(count(text, "<details><summary>sweep, going "), 1U);
  EXPECT_EQ(count(text, "<td>sweep</td></tr>"), 1U);
  EXPECT_EQ(count(text, "<h3>What moved the choice</h3>"), 2U) << "a sweep is no choice";
}

TEST_F(PageTest, SaysWhichRuleEndedASimulatedFlightWhatHappenedBeforeAndWhatIsLeftOfTheBattery) {
  fs::remove(folder_ / "journal.lcmlog");
  {
    SeaJournal journal(folder_ / "journal.lcmlog");
    journal.acknowledge(10, messages::Order::kStart, messages::CommandOutcome::kObeyed);
    journal.state(10, messages::MissionState::kSearch, messages::EndReason::kNone, 0);
    journal.rule(600, {.time = {},
                       .rule = 9,
                       .condition = config::Condition::kBattery,
                       .response = config::Response::kAbort,
                       .begins = true,
                       .measure = 29.998,
                       .limit = 30.0});
    journal.state(600, messages::MissionState::kAbort, messages::EndReason::kSafetyRule, 3);
    journal.end(messages::Ending::kMissionOver);
  }
  Flight flight = read_flight(folder_);
  flight.summary["end_reason"] = "safety_rule";
  EXPECT_EQ(count(page(flight, {}, {}), "battery left"), 0U);
  flight.summary["battery_percent"] = 29.998;
  const std::string text = page(flight, {}, {});
  EXPECT_TRUE(
      support::has_line(text, {"<h1", "not found", "3 steps", "rule 10", "battery_percent", "29.998", "below 30.000", "abort</h1>"}));
  EXPECT_EQ(count(text, "<h2>What happened</h2>"), 1U);
  EXPECT_TRUE(support::has_line(text, {"<td>10 min</td>", "rule 10", "battery_percent", "29.998", "below 30.000", "abort</td>"}));
  EXPECT_TRUE(support::has_line(text, {"START", "number 1", "issuer 1", messages::to_string(messages::CommandOutcome::kObeyed)}));
  EXPECT_TRUE(support::has_line(text, {"simulator", "START", "COMPLETE", "within a step length"}));
  EXPECT_EQ(count(text, "<dt>battery left</dt><dd>30.0 %</dd>"), 1U);
  EXPECT_EQ(count(text, "Refused as they came in"), 0U);
}

TEST_F(PageTest, OfAFlightWithoutItsPolicyStillListsEveryDecisionAndSaysWhatIsMissing) {
  fs::remove(folder_ / "journal.policy");
  const FlightExplanation explanation = explain_flight(folder_);
  EXPECT_TRUE(explanation.accounts.empty());
  EXPECT_TRUE(explanation.is_incomplete);
  const std::string text = page(read_flight(folder_), {}, explanation);
  EXPECT_EQ(count(text, "<details>"), 0U);
  EXPECT_EQ(count(text, "Not explained: "), 1U);
  EXPECT_EQ(count(text, "class=\"p taken\""), 3U) << "one action taken at each of three decisions";
  EXPECT_EQ(count(text, "<th>N</th><th>NE</th><th>E</th><th>SE</th><th>S</th><th>SW</th><th>W</th><th>NW</th>"), 1U);
}

TEST_F(PageTest, OfAJournalAloneListsEveryDecisionAndSaysWhatIsMissing) {
  for (const char* name : {"summary.json", "track.csv", "snr.csv"}) fs::remove(folder_ / name);
  const FlightExplanation explanation = explain_flight(folder_);
  EXPECT_EQ(explanation.why_not, "");
  const std::string text = page(read_flight(folder_), {}, explanation);
  EXPECT_TRUE(support::has_line(text, {"Not there", "summary.json", "track.csv", "snr.csv"}));
  EXPECT_EQ(count(text, "<details><summary>why "), 3U);
}

TEST_F(PageTest, SaysWhereTheJournalIsDamagedAndHowMuchOfItIsRead) {
  const fs::path journal = folder_ / "journal.lcmlog";
  const auto size = fs::file_size(journal);
  const auto of_decisions = size - kClosingBytes;
  ASSERT_EQ(of_decisions % 3, 0U) << "three decisions of one length";
  {
    std::fstream file(journal, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(of_decisions / 3 + 100));
    file.put('\x55');
  }
  const std::string said = "The journal is damaged: " + std::to_string(of_decisions / 3) + " bytes from byte " +
                           std::to_string(of_decisions / 3) +
                           " on are no record. What stands behind was read. The journal lacks 1 records from number 1 on: damaged, or the "
                           "disk was full or too slow.";
  EXPECT_EQ(read_journal(journal).decisions.size(), 2U);
  EXPECT_EQ(lack_of(read_journal(journal)), said);
  EXPECT_EQ(count(page(read_flight(folder_), {}, {}), said), 1U);
}

TEST_F(PageTest, TellsACutJournalFromADamagedOne) {
  const fs::path journal = folder_ / "journal.lcmlog";
  EXPECT_EQ(lack_of(read_journal(journal)), "");
  const auto record = (fs::file_size(journal) - kClosingBytes) / 3;  // three decisions of one length
  fs::resize_file(journal, 3 * record - 1);
  const std::string said = lack_of(read_journal(journal));
  const std::string third = std::to_string(2 * record);
  EXPECT_TRUE(support::tells(said, {"journal", "ends", std::to_string(record - 1), third, std::to_string(3 * record - 1), "no", "record",
                                    "stopped", "before it", "2 records", "2 decisions"}));
}

TEST_F(PageTest, SaysFromWhichNumberOnAJournalLacksWhatAFullDiskDidNotTake) {
  const fs::path journal = folder_ / "journal.lcmlog";
  std::ifstream file(journal, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t record = (bytes.size() - kClosingBytes) / 3;
  bytes.erase(record, record);  // the second of three decisions of one length
  std::ofstream(journal, std::ios::binary) << bytes;
  EXPECT_FALSE(read_journal(journal).is_whole());
  const std::string said = "The journal lacks 1 records from number 1 on: the disk was full or too slow.";
  EXPECT_EQ(lack_of(read_journal(journal)), said);
  EXPECT_EQ(count(page(read_flight(folder_), {}, {}), said), 1U);
}

TEST_F(PageTest, SaysThatTheEndOfAJournalIsMissingThatWasNotEndedInOrder) {
  const fs::path journal = folder_ / "journal.lcmlog";
  EXPECT_TRUE(read_journal(journal).is_whole());
  fs::resize_file(journal, fs::file_size(journal) - kClosingBytes);  // as a kill leaves it
  EXPECT_FALSE(read_journal(journal).is_whole());
  const std::string said =
      "The journal's end is missing: no closing record stands behind its last record, for the runtime was killed, lost its power, met an "
      "error, or is of a version that wrote none.";
  EXPECT_EQ(lack_of(read_journal(journal)), said);
  EXPECT_EQ(count(page(read_flight(folder_), {}, {}), said), 1U);
}

}  // namespace
}  // namespace earshot::report
