#include "policy/description/element_names.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "policy/description/state.hpp"

namespace earshot::description {
namespace {

std::vector<std::string> names_of(State state, std::size_t remembered_steps) {
  return element_names(observation_of(state, remembered_steps, search::SearchSettings{}).spec);
}

TEST(ElementNames, TellPlaceAndRememberedStepsApart) {
  EXPECT_EQ(names_of(State::kSimple, 2), (std::vector<std::string>{"east", "north"}));
  EXPECT_EQ(names_of(State::kMemory, 2),
            (std::vector<std::string>{"step_east_0", "step_north_0", "step_snr_0", "step_east_1", "step_north_1", "step_snr_1"}));
}

TEST(ElementNames, AreAllKnownAndNoTwoAlike) {
  for (const State state : {State::kSimple, State::kMemory, State::kPositionMemory, State::kBelief}) {
    const std::vector<std::string> names = names_of(state, 3);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string& name : names) EXPECT_NE(name, "unknown");
  }
  const std::vector<std::string> belief = names_of(State::kBelief, 2);
  for (const char* name : {"to_south_edge", "likeliest_north", "spread", "found_0", "preference_7", "approach_7"})
    EXPECT_NE(std::ranges::find(belief, name), belief.end()) << name;
}

/// Every number that policy::is_known() lets pass has a name of its own.
TEST(ElementNames, LeaveNoFeatureOut) {
  std::set<std::string> names;
  std::size_t known = 0;
  for (int number = 0; number < 256; ++number) {
    const auto feature = static_cast<policy::Feature>(number);
    if (!policy::is_known(feature)) continue;
    policy::ObservationSpec spec;
    ASSERT_EQ(spec.push_back({.feature = feature}), Status::kOk);
    names.insert(element_names(spec)[0]);
    ++known;
  }
  EXPECT_EQ(names.size(), known);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace earshot::description
