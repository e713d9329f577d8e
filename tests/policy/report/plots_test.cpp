#include "policy/report/plots.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/occurrences.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

class PlotsTest : public testing::Test {
 protected:
  PlotsTest() { write_flight(folder_, *policy_, explain::flown(*policy_, 3, {}), {}); }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(PlotsTest, ShowsSnrOnTheScaleOfEveryFieldUnderATrackThatStandsOutOnAnyColourOfIt) {
  const std::string svg = map_svg(read_flight(folder_));
  for (const char* tic : {">-10<", "> 40<"}) EXPECT_EQ(count(svg, tic), 1U) << "20 dB below the threshold of 10 dB to 30 above";
  EXPECT_TRUE(support::has_line(svg, {"<title>", "SNR", "track</title>"}));
  EXPECT_GT(svg.find("stroke='rgb(194,  18, 122)'"), svg.find("stroke='rgb(255, 255, 255)'")) << "the track lies on a white line";
  EXPECT_EQ(count(svg, "<polygon fill = 'rgb( 29,  92, 138)'"), 0U) << "the legend has no ground of its own";
  EXPECT_TRUE(support::has_line(history_svg(read_flight(folder_)), {"<title>", "SNR", "range", "time</title>"}));
}

}  // namespace
}  // namespace earshot::report
