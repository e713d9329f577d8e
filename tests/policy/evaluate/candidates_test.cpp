#include "policy/evaluate/candidates.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::evaluate {
namespace {

Candidate learned(const std::string& name, std::string_view provenance) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->step_length = Meters{1'000.0};
  policy->area_size = {Meters{25'000.0}, Meters{25'000.0}};
  policy->detection_threshold = Decibels{10.0};
  for (const char letter : provenance) EXPECT_EQ(policy->provenance.push_back(letter), Status::kOk);
  return {name, std::move(policy)};
}

std::vector<Candidate> both(Candidate a, Candidate b) {
  std::vector<Candidate> candidates;
  candidates.push_back({"oracle", nullptr});
  candidates.push_back(std::move(a));
  candidates.push_back(std::move(b));
  return candidates;
}

TEST(Candidates, AreBaselinesByNameOrFiles) {
  EXPECT_EQ(candidate_named("bayes").learned, nullptr);
  EXPECT_EQ(candidate_named(EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy").learned->step_length, Meters{1'000.0});
  EXPECT_THROW((void)candidate_named("swordfish"), host::BadInput);
}

TEST(Candidates, SearchForTheSourceThatTheLearnedOnesWereTrainedWith) {
  EXPECT_EQ(placement_of(both(learned("a", "source = fixed\n"), learned("b", ""))), search::SourcePlacement::kFixed);
  EXPECT_EQ(placement_of(both(learned("a", ""), learned("b", ""))), search::SourcePlacement::kChanging);
  EXPECT_THROW((void)placement_of(both(learned("a", "source = fixed\n"), learned("b", "source = changing\n"))), host::BadInput);
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
