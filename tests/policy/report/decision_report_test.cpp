#include "policy/report/decision_report.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/occurrences.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

class DecisionReportTest : public testing::Test {
 protected:
  DecisionReportTest() { write_flight(folder_, *policy_, explain::flown(*policy_, 3, {}), {}); }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(DecisionReportTest, SaysTheSameInEveryFormat) {
  const RecordedFlight flight = open_recording(folder_, {});
  const DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  const auto json = nlohmann::json::parse(as_json(report));
  for (const auto& sentence : json["summary"]) EXPECT_EQ(count(as_markdown(report), sentence.get<std::string>()), 1U) << sentence;
}

TEST_F(DecisionReportTest, StatesThatItIsASimulationAndGivesFrequencyDepthPlaceAndDate) {
  nlohmann::json summary = nlohmann::json::parse(std::ifstream(folder_ / "summary.json"));
  summary["source_frequency_hz"] = 20.0;
  summary["depth_m"] = 300.0;
  summary["speed_mps"] = 1.5;
  summary["flown_utc"] = "2026-11-30 12:00:00";
  summary["origin"] = {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}};
  std::ofstream(folder_ / "summary.json") << summary;
  const RecordedFlight flight = open_recording(folder_, {});
  const DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  const std::string markdown = as_markdown(report);
  EXPECT_TRUE(support::has_line(markdown, {"This flight is a simulation", "no vehicle was at sea"}));
  EXPECT_TRUE(support::has_line(
      markdown, {"Frequency of the source 20.0 Hz", "300 m", "1.5 m/s", "38.500\u00B0 N, 28.000\u00B0 W", "2026-11-30 12:00:00 UTC"}));
  const auto conditions = nlohmann::json::parse(as_json(report))["conditions"];
  EXPECT_EQ(conditions["simulated"], true);
  EXPECT_EQ(conditions["source_frequency_hz"], 20.0);
  EXPECT_EQ(conditions["depth_m"], 300.0);
}

TEST_F(DecisionReportTest, TellsAMeasurementTooFaintToMeasureFromAMeasuredOne) {
  const RecordedFlight flight = open_recording(folder_, {});
  const std::string first = as_markdown(make_decision_report(flight, 0, explain::Baseline::kCentre));
  EXPECT_TRUE(support::has_line(first, {"too faint", "below 31.0 dB"}));
  EXPECT_EQ(count(first, "under 31.0 dB |"), 1U);
  EXPECT_EQ(count(as_markdown(make_decision_report(flight, 2, explain::Baseline::kCentre)), "a detection (threshold 10 dB)."), 1U);
}

TEST_F(DecisionReportTest, SaysWhyTheVehicleSweptInPlaceOfWhatThePolicyWouldHaveDone) {
  const RecordedFlight flight = open_recording(folder_, {});
  DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  report.account.decision.sweeping = true;
  report.account.decision.belief.emplace().mismatch_bits = 9.25F;
  report.account.decision.was_mismatched = true;
  const std::string markdown = as_markdown(report);
  EXPECT_TRUE(support::has_line(markdown, {"sweeps", "not by the policy"}));
  EXPECT_TRUE(support::has_line(markdown, {"fits no ocean", "9.2 bits"}));
  EXPECT_EQ(count(markdown, ": a sweep, going "), 1U) << "the title";
  EXPECT_EQ(count(markdown, "It chose "), 0U);
  EXPECT_EQ(count(markdown, "| direction |"), 0U);
  EXPECT_EQ(nlohmann::json::parse(as_json(report))["sweeping"], true);
}

TEST_F(DecisionReportTest, SaysThatTheVehicleSweptBecauseItHadHeardNothingWhereNoMismatchWas) {
  const RecordedFlight flight = open_recording(folder_, {});
  DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  report.account.decision.sweeping = true;
  EXPECT_TRUE(support::has_line(as_markdown(report), {"detected nothing", "predict detections"}));
  EXPECT_EQ(count(as_markdown(report), "fits no ocean"), 0U);
}

TEST_F(DecisionReportTest, SaysThatTheVehicleDeclaredTheSourceFound) {
  const RecordedFlight flight = open_recording(folder_, {});
  DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  EXPECT_EQ(count(as_markdown(report), "found: with"), 0U);
  EXPECT_EQ(nlohmann::json::parse(as_json(report))["found_probability"], nullptr);
  report.account.decision.found.emplace().probability = 0.93F;
  EXPECT_TRUE(support::has_line(as_markdown(report), {"declared", "found", "93 %", "within a step"}));
}

TEST_F(DecisionReportTest, ShowsWhatMovedTheChoiceOfANetworkAlone) {
  const RecordedFlight flight = open_recording(folder_, {});
  DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  EXPECT_EQ(count(as_markdown(report), "integrated gradients"), 1U);
  for (explain::ActionAccount& action : report.account.actions) action.worth = 1.0;
  EXPECT_EQ(count(as_markdown(report), "integrated gradients"), 0U);
  EXPECT_EQ(count(as_markdown(report), "| direction |"), 1U);
}

}  // namespace
}  // namespace earshot::report
