#include "policy/report/page.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/occurrences.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"

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
  EXPECT_EQ(count(text, "<h3>What moved the choice</h3>\n<p>How much each number that the policy received moved the choice"), 3U);
  EXPECT_EQ(count(text, "<svg"), 4U) << "the map and a chart for each decision";
  EXPECT_EQ(count(text, "The safety layer moved the way-point"), 1U);
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
  EXPECT_EQ(count(text, "Source found after 16 steps: the vehicle came within one step length of it</h1>"), 1U);
  EXPECT_EQ(count(text, "<p>The last step was cut short by the source.</p>"), 1U);
  EXPECT_EQ(count(text, "15 steps"), 0U);
  flight.summary["whole_steps"] = 16;
  EXPECT_EQ(count(page(flight, {}, {}), "cut short"), 0U);
}

TEST_F(PageTest, SaysThatTheMissionEndedWithinTheStepOfTheLastDecision) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "within the step"), 0U) << "3 steps, 3 decisions";
  flight.summary["steps"] = 2;
  EXPECT_EQ(count(page(flight, {}, {}), "<p>The mission ended within the step of the last of 3 decisions, which does not count.</p>"), 1U);
}

TEST_F(PageTest, GivesInItsHeadTheModelMismatchTheSweepAndTheWrongDeclaration) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "mismatch"), 0U) << "a summary of an earlier version";
  flight.summary["surprise_bits"] = 13.25;
  flight.summary["surprised_from_step"] = 9;
  flight.summary["swept_from_step"] = 11;
  flight.summary["max_steps"] = 100;
  const std::string swept = page(flight, {}, {});
  EXPECT_EQ(count(swept, "<h1 class=\"missed\">Source not found in 3 steps: a test</h1>"), 1U);
  EXPECT_EQ(count(swept, "(model-mismatch score 13.2 bits at the end; from 6.75 on it is a mismatch). From step 11 of 100 on it swept"),
            1U);
  flight.summary["end_reason"] = "found";
  flight.summary["step_length_m"] = 1'000.0;
  flight.summary["declared_found"] = {{"step", 3}, {"range_m", 1'020.6}};
  const std::string declared = page(flight, {}, {});
  EXPECT_EQ(
      count(declared,
            "<h1 class=\"missed\">Source not found in 3 steps: the vehicle declared it found at step 3, wrongly, 1021 m from it</h1>"),
      1U);
  EXPECT_EQ(count(declared, "Source found"), 0U);
  flight.summary["end_reason"] = "declared_found";
  EXPECT_EQ(page(flight, {}, {}), declared) << "a summary of an earlier version";
}

TEST_F(PageTest, NeverDeniesASourceThatTheVehicleRightlyDeclaredFound) {
  Flight flight = read_flight(folder_);
  flight.summary["step_length_m"] = 1'000.0;
  flight.summary["declared_found"] = {{"step", 2}, {"range_m", 640.0}};
  const std::string text = page(flight, {}, {});
  EXPECT_EQ(count(text, "<h1 class=\"found\">Source found: the vehicle declared it found at step 2, 640 m from it</h1>"), 1U);
  EXPECT_EQ(count(text, "not found"), 0U);
  EXPECT_EQ(count(text, "class=\"missed\""), 0U);
  EXPECT_EQ(count(text, "<dt>found</dt><dd>yes</dd>"), 1U);
}

TEST_F(PageTest, StatesThatItIsASimulationAndThatTheColouredFieldIsTheTruthThatTheVehicleNeverSaw) {
  const std::string text = page(read_flight(folder_), {.map = "<svg>map</svg>", .history = ""}, {});
  EXPECT_EQ(count(text, "This flight is a simulation."), 1U);
  EXPECT_EQ(
      count(text,
            "The coloured field is the truth, the SNR at the vehicle's depth as the simulation computes it. The vehicle never saw it."),
      1U);
}

TEST_F(PageTest, GivesFrequencyDepthSpeedPlaceAndDateAndWhatEachResultMeans) {
  Flight flight = read_flight(folder_);
  EXPECT_EQ(count(page(flight, {}, {}), "<dt>frequency of the source</dt>"), 0U) << "a summary of an earlier version";
  flight.summary["source_frequency_hz"] = 20.0;
  flight.summary["depth_m"] = 300.0;
  flight.summary["speed_mps"] = 2.0;
  flight.summary["origin"] = {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}};
  flight.summary["flown_utc"] = "2026-11-29 18:38:46";
  const std::string text = page(flight, {}, {});
  EXPECT_EQ(count(text, "<dt>frequency of the source</dt><dd>20.0 Hz</dd>"), 1U);
  EXPECT_EQ(count(text, "<dt>depth of the vehicle</dt><dd>300 m</dd>"), 1U);
  EXPECT_EQ(count(text, "<dt>speed of the vehicle</dt><dd>2.0 m/s</dd>"), 1U);
  EXPECT_EQ(count(text, "its south-west corner lies at 38.500\u00B0 N, 28.000\u00B0 W"), 1U);
  EXPECT_EQ(count(text, "<dt>simulated on</dt><dd>2026-11-29 18:38:46 UTC</dd>"), 1U);
  for (const char* meaning : {"0 for each step that ends with a detection", "a step that ends with an SNR of 10 dB or more",
                              "the vehicle came within one step length of the source", "the vehicle's own rule reports"})
    EXPECT_EQ(count(text, std::string("<dd class=\"meaning\">") + meaning), 1U) << meaning;
}

TEST_F(PageTest, StatesThatARowIsTheDecisionThatBeginsAStepAndThatTheLastStepsEndHasNone) {
  const std::string text = page(read_flight(folder_), {}, {});
  EXPECT_EQ(count(text, "<p>A row is the decision that begins a step, the first that of step 0. Its SNR was measured before it."), 1U);
  EXPECT_EQ(count(text, "What was measured at the end of the last step has no row"), 1U);
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
  EXPECT_EQ(count(text, "Source not found in 3 steps: safety rule 10, battery_percent: 29.998, below 30.000: abort</h1>"), 1U);
  EXPECT_EQ(count(text, "<h2>What happened</h2>"), 1U);
  EXPECT_EQ(count(text, "<td>10 min</td><td class=\"left\">rule 10, battery_percent: 29.998, below 30.000: abort</td>"), 1U);
  EXPECT_EQ(count(text, "<td class=\"left\">order START, number 1 of issuer 1: obeyed</td>"), 1U);
  EXPECT_EQ(count(text, "<p>The simulator gave the orders: START, COMPLETE once the vehicle was within a step length of the source"), 1U);
  EXPECT_EQ(count(text, "<dt>battery left</dt><dd>30.0 %</dd>"), 1U);
  EXPECT_EQ(count(text, "Refused as they came in"), 0U);
}

TEST_F(PageTest, OfAFlightWithoutItsPolicyStillListsEveryDecisionAndSaysWhatIsMissing) {
  fs::remove(folder_ / "journal.policy");
  const FlightExplanation explanation = explain_flight(folder_);
  EXPECT_TRUE(explanation.accounts.empty());
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
  EXPECT_EQ(count(text, "Not there: summary.json, track.csv, snr.csv."), 1U);
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
  EXPECT_EQ(said, "The journal ends with " + std::to_string(record - 1) + " bytes from byte " + third + " on of " +
                      std::to_string(3 * record - 1) +
                      ", which are no whole record: the runtime was stopped while it wrote. Read before it: 2 records, 2 decisions among "
                      "them.");
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
