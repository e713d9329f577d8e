#include "policy/report/decision_report.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace earshot::report
