#include "policy/evaluate/candidates.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/policy/evaluate/made_up_candidates.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

TEST(Candidates, AreBaselinesAndWhatShipsByNameOrFiles) {
  EXPECT_EQ(candidate_named("bayes").learned, nullptr);
  EXPECT_EQ(candidate_named(EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy").learned->step_length, Meters{1'000.0});
  EXPECT_EQ(candidate_named("fixed_source").file.filename(), "fixed_source.policy");
  EXPECT_THROW((void)candidate_named("swordfish"), host::BadInput);
}

std::string refusal_of(const std::string& name) {
  try {
    (void)candidate_named(name);
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(Candidates, AreToldFromWorldsEnvironmentsAndMissionsThatStandInTheirPlace) {
  const std::string root = EARSHOT_SOURCE_DIR;
  EXPECT_TRUE(support::tells(refusal_of("rock"), {"POLICY", "rock", "not", "policy", "--world", root, "/policy/worlds/rock.toml"}));
  for (const char* file :
       {"/policy/worlds/rock.toml", "/sim/ocean/environments/munk_flat.toml", "/firmware/boards/linux/missions/search.toml"})
    EXPECT_TRUE(support::tells(refusal_of(root + file), {"POLICY", root, file, "no", "--environment", "--world", "--mission"}));
}

TEST(Candidates, FlyOnceUnderWhateverNamesTheyAreGiven) {
  std::vector<Candidate> candidates;
  for (const char* name : {"bayes", "fixed_source", "bayes", EARSHOT_SOURCE_DIR "/policy/frozen/../frozen/fixed_source.policy", "oracle"})
    candidates.push_back(candidate_named(name));
  const std::vector<std::string> said = leave_out_repeated(candidates);
  ASSERT_EQ(candidates.size(), 3U);
  EXPECT_EQ(candidates[0].name, "bayes");
  EXPECT_EQ(candidates[1].name, "fixed_source");
  EXPECT_EQ(candidates[2].name, "oracle");
  EXPECT_EQ(said, (std::vector<std::string>{"bayes: named twice, flies once", EARSHOT_SOURCE_DIR
                                            "/policy/frozen/../frozen/fixed_source.policy: is fixed_source, flies once"}));
}

TEST(Candidates, ThatAreGivenAnOceanAreNamedWithIt) {
  std::vector<Candidate> candidates;
  for (const char* name : {"bayes", "oracle", "bayes_least_regret"}) candidates.push_back(candidate_named(name));
  EXPECT_EQ(given_oceans(candidates, "a/munk.toml", true),
            "bayes, bayes_least_regret: given the true ocean, which a vehicle does not know\n");
  EXPECT_EQ(given_oceans(candidates, "a/munk.toml", false),
            "bayes, bayes_least_regret: given the ocean of munk.toml, in whichever world they search\n");
  candidates.clear();
  candidates.push_back(candidate_named("oracle"));
  EXPECT_EQ(given_oceans(candidates, "a/munk.toml", true), "");
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
