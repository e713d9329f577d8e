#include "policy/evaluate/candidates.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/evaluate/made_up_candidates.hpp"

namespace earshot::evaluate {
namespace {

TEST(Candidates, AreBaselinesAndWhatShipsByNameOrFiles) {
  EXPECT_EQ(candidate_named("bayes").learned, nullptr);
  EXPECT_EQ(candidate_named(EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy").learned->step_length, Meters{1'000.0});
  EXPECT_EQ(candidate_named("fixed_source").file.filename(), "fixed_source.policy");
  EXPECT_THROW((void)candidate_named("swordfish"), host::BadInput);
}

TEST(Candidates, MustHaveBeenTrainedForOneSearch) {
  EXPECT_EQ(settings_of(both(learned("a", ""), learned("b", ""))).step_length, Meters{1'000.0});
  Candidate other = learned("b", "");
  other.learned->detection_threshold = Decibels{9.0};
  EXPECT_THROW((void)settings_of(both(learned("a", ""), std::move(other))), host::BadInput);
}

TEST(Candidates, MustListenOverOneWindowUnlessOneIsGivenToAll) {
  EXPECT_NO_THROW(check_same_listening(both(learned("a", ""), learned("b", ""))));
  Candidate other = learned("b", "");
  other.learned->observation.listening = {config::Listening::kMean, Duration::seconds(30)};
  EXPECT_THROW(check_same_listening(both(learned("a", ""), std::move(other))), host::BadInput);
}

}  // namespace
}  // namespace earshot::evaluate
