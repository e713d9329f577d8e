#include "policy/description/state.hpp"

#include <gtest/gtest.h>

namespace earshot::description {
namespace {

TEST(State, HasOneNameBothWays) {
  for (const std::string_view name : kStates) EXPECT_EQ(name_of(state_named(name).value()), name);
  EXPECT_EQ(state_named("position_memory"), State::kPositionMemory);
  EXPECT_EQ(state_named("Simple"), std::nullopt);
}

TEST(State, StatesInPlainWordsWhatIsObserved) {
  EXPECT_EQ(what_is_observed(State::kSimple), "its place");
  EXPECT_EQ(what_is_observed(State::kMemory), "the SNR of its last steps");
  EXPECT_EQ(what_is_observed(State::kBelief), "its belief about the source");
  EXPECT_EQ(what_is_observed(State::kPositionMemory), "its place and the SNR of its last steps");
}

TEST(State, ShowsThePositionTheRememberedStepsOrBoth) {
  const search::SearchSettings settings;
  const auto size = [&](State state) { return observation_of(state, 2, settings).spec.size(); };
  EXPECT_EQ(size(State::kSimple), 2U);          // x, y
  EXPECT_EQ(size(State::kMemory), 6U);          // dx, dy and SNR of two steps
  EXPECT_EQ(size(State::kPositionMemory), 8U);  // and both
  EXPECT_TRUE(policy::needs_belief(observation_of(State::kBelief, 2, settings).spec));
}

TEST(State, RemembersNoMoreThanFitsIntoAnObservation) {
  const search::SearchSettings settings;
  for (const State state : {State::kMemory, State::kPositionMemory}) {
    EXPECT_TRUE(remembers(state));
    EXPECT_LE(observation_of(state, most_remembered(state), settings).spec.size(), config::kMaxObservation);
  }
  EXPECT_FALSE(remembers(State::kSimple));
  EXPECT_FALSE(remembers(State::kBelief));
}

}  // namespace
}  // namespace earshot::description
