#include "policy/command_line/listening_options.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::command_line {
namespace {

using config::Listening;
using config::ListeningWindow;

constexpr ListeningWindow kMeanOfThirty{Listening::kMean, Duration::seconds(30)};

ListeningOptions options_of(const std::vector<std::string>& words) {
  ListeningOptions options;
  program::CommandLine line("earshot test", "");
  options.add_to(line, "newest");
  (void)line.read(words);
  return options;
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    (void)options_of(words).applied_to(kMeanOfThirty);
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(ListeningOptions, LeaveTheWindowAsItStandsWhereNothingIsGiven) {
  EXPECT_FALSE(options_of({}).is_given());
  EXPECT_EQ(options_of({}).applied_to(kMeanOfThirty), kMeanOfThirty);
}

TEST(ListeningOptions, TakeTheLengthThatStandsForAWordAloneAndTheWordForALengthAlone) {
  EXPECT_EQ(options_of({"--listening", "loudest"}).applied_to(kMeanOfThirty),
            (ListeningWindow{Listening::kLoudest, Duration::seconds(30)}));
  EXPECT_EQ(options_of({"--listening-window-s", "7"}).applied_to(kMeanOfThirty), (ListeningWindow{Listening::kMean, Duration::seconds(7)}));
  EXPECT_EQ(options_of({"--listening", "newest"}).applied_to(kMeanOfThirty), ListeningWindow{});
  EXPECT_TRUE(options_of({"--listening", "newest"}).is_given());
}

TEST(ListeningOptions, RefuseAWindowThatCannotBeListenedOverAndNameBothOptions) {
  EXPECT_TRUE(support::tells(refusal({"--listening", "newest", "--listening-window-s", "5"}),
                             {"--listening", "--listening-window-s", "newest", "without", "not", "5 s"}));
  EXPECT_TRUE(support::tells(refusal({"--listening-window-s", "0"}),
                             {"--listening", "--listening-window-s", "mean", "needs", "1 to 120 s", "not 0"}));
  EXPECT_NE(refusal({"--listening-window-s", "121"}).find("121: must be whole seconds, 1 to 120"), std::string::npos);
}

}  // namespace
}  // namespace earshot::command_line
