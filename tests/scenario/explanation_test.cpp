// What a flight leaves behind explains its decisions.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kSource = EARSHOT_SOURCE_DIR;
const fs::path kBin = EARSHOT_BIN_DIR;
const fs::path kFrozen = kSource / "policy/frozen";

class Explanation : public testing::Test {
 protected:
  void fly(const fs::path& policy, const std::string& mission) {
    support::Process flight(
        kBin / "earshot-fly",
        {"--policy", policy, "--public-key", kFrozen / "earshot.pub", "--environment", kSource / "sim/ocean/environments/munk_flat.toml",
         "--mission", kSource / "firmware/boards/linux/missions" / mission, "--out", folder_ / "out", "--no-report"},
        folder_ / "fly.txt");
    ASSERT_EQ(flight.wait(120s), 0) << flight.output();
    EXPECT_EQ(support::read_text(folder_ / "out/journal.policy"), support::read_text(policy)) << "the policy stands beside its journal";
  }

  /// The report about the second decision.
  [[nodiscard]] nlohmann::json explained() {
    support::Process explain(kBin / "earshot-explain", {"decision", folder_ / "out", "--step", "1", "-o", folder_ / "decision.json"},
                             folder_ / "explain.txt");
    EXPECT_EQ(explain.wait(60s), 0) << explain.output();
    return nlohmann::json::parse(support::read_text(folder_ / "decision.json"));
  }

  const support::TemporaryFolder folder_;
};

TEST_F(Explanation, GivenAFlightOnABeliefItsBeliefIsMadeAgainBitForBitAndTheChoiceIsSharedOutWhole) {
  ASSERT_NO_FATAL_FAILURE(fly(kFrozen / "shipped.policy", "search.toml"));
  EXPECT_EQ(support::read_text(folder_ / "out/journal.tables"), support::read_text(kSource / "policy/tables/shipped/20hz_300m.tables"))
      << "the tables that it searched by stand beside its journal, too";
  const nlohmann::json report = explained();
  EXPECT_EQ(report["belief"]["whose"], "the policy's");
  EXPECT_TRUE(report["attribution"]["complete"].get<bool>());
}

TEST_F(Explanation, GivenAFlightOnItsPlaceAloneAnObserversBeliefIsShown) {
  ASSERT_NO_FATAL_FAILURE(fly(kFrozen / "fixed_source.policy", "fixed_source.toml"));
  const nlohmann::json report = explained();
  EXPECT_EQ(report["belief"]["whose"], "an observer's");
  EXPECT_TRUE(report["attribution"]["complete"].get<bool>());
}

}  // namespace
}  // namespace earshot
