// What a flight leaves behind explains its decisions.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/policy/report/document/type_complaints.hpp"
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

/// Its rows of turns are held against those of `earshot journal --csv`, which another program writes.
TEST_F(Explanation, GivenAFlightThatHeardItsPageIsGivenWhatItsTypesDescribeAndTheJournalsNumbers) {
  if (!fs::exists(report::kTypeScript)) GTEST_SKIP() << report::kTypeScript << " is not installed (Debian: node-typescript)";
  support::Process flight(kBin / "earshot-fly", {"--hear", "synthetic", "--out", folder_ / "out", "--no-report"}, folder_ / "fly.txt");
  ASSERT_EQ(flight.wait(120s), 0) << flight.output();
  support::Process report(kBin / "earshot-report", {folder_ / "out", "--json", folder_ / "flight.json"}, folder_ / "report.txt");
  ASSERT_EQ(report.wait(60s), 0) << report.output();
  const std::string text = support::read_text(folder_ / "flight.json");
  EXPECT_EQ(report::type_complaints("Flight", text, folder_), "");
  const nlohmann::json made = nlohmann::json::parse(text);
  EXPECT_TRUE(made["sound"].is_object());
  for (const auto& decision : made["decisions"]) EXPECT_FALSE(decision["reasons"].empty()) << decision["step"];

  support::Process journal(kBin / "earshot-journal", {folder_ / "out", "--csv", folder_ / "turns.csv"}, folder_ / "journal.txt");
  ASSERT_EQ(journal.wait(60s), 0) << journal.output();
  std::map<long, std::vector<std::string>> turns;  // by tenths of a second
  std::ifstream table(folder_ / "turns.csv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    constexpr std::size_t kMission_s = 2;
    turns[std::lround(10.0 * std::stod(cells.at(kMission_s)))] = cells;
  }
  const nlohmann::json& strips = made["strips"];
  const auto expect_near = [&](const char* column, std::size_t row, std::size_t of_table, double most) {
    const std::string& cell = turns.at(std::lround(10.0 * strips["time_s"][row].get<double>())).at(of_table);
    if (strips[column][row].is_number()) {
      EXPECT_NEAR(strips[column][row].get<double>(), std::stod(cell), most) << column << ", row " << row;
    }
  };
  EXPECT_GT(strips["time_s"].size(), 4'000U) << "a flight of " << turns.size() << " turns";
  for (std::size_t row = 0; row < strips["time_s"].size(); ++row) {
    constexpr std::size_t kNorth_m = 8;
    constexpr std::size_t kSnr_db = 16;
    constexpr std::size_t kWaypointEast_m = 22;
    expect_near("north_m", row, kNorth_m, 0.0501);
    expect_near("snr_db", row, kSnr_db, 0.00501);
    expect_near("waypoint_east_m", row, kWaypointEast_m, 0.0501);
  }
}

}  // namespace
}  // namespace earshot
