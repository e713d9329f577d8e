#include "policy/report/decision_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::report {
namespace {

class DecisionReportJsonTest : public testing::Test {
 protected:
  DecisionReportJsonTest() { write_flight(folder_, *policy_, explain::flown(*policy_, 3, {}), {}); }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(DecisionReportJsonTest, HasPartsThatAddUpToWhatTheyExplain) {
  const RecordedFlight flight = open_recording(folder_, {});
  const DecisionReport report = make_decision_report(flight, 2, explain::Baseline::kCentre);
  const auto json = nlohmann::json::parse(as_json(report));
  EXPECT_EQ(json["step"], 2);
  EXPECT_TRUE(json["attribution"]["complete"].get<bool>());
  EXPECT_EQ(json["actions"].size(), 8U);
  EXPECT_EQ(json["looks"].size(), 3U);
  double parts = 0.0;
  for (const auto& part : json["attribution"]["parts"]) parts += part["nats"].get<double>();
  const double difference =
      json["attribution"]["log_probability"].get<double>() - json["attribution"]["log_probability_at_baseline"].get<double>();
  EXPECT_NEAR(parts, difference, json["attribution"]["tolerance"].get<double>());
}

TEST_F(DecisionReportJsonTest, TellsOfEachLikelyHypothesisWhichOceanHowLoudHowSureHowSilentAndWhetherItMoves) {
  const RecordedFlight flight = open_recording(folder_, {});
  const auto json = nlohmann::json::parse(as_json(make_decision_report(flight, 2, explain::Baseline::kCentre)));
  const auto& hypotheses = json["belief"]["hypotheses"];
  ASSERT_FALSE(hypotheses.empty());
  double last = 1.0;
  for (const auto& hypothesis : hypotheses) {
    EXPECT_EQ(hypothesis["ocean"], "falling");
    EXPECT_EQ(std::fmod(hypothesis["level_offset_db"].get<double>(), 3.0), 0.0);
    EXPECT_GE(hypothesis["spread_db"], 1.0);
    EXPECT_GE(hypothesis["silence_share"], 0.0);
    EXPECT_TRUE(hypothesis["moving"].is_boolean());
    EXPECT_GE(hypothesis["probability"], 0.01);
    EXPECT_LE(hypothesis["probability"], last);
    last = hypothesis["probability"].get<double>();
  }
  EXPECT_EQ(hypotheses[0]["level_offset_db"], 0.0) << "the source is as loud as its table says";
}

}  // namespace
}  // namespace earshot::report
