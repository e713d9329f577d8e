// earshot init as a person meets it: what its README says is done, word for word, from a folder that has nothing to do with it.
#include <string>
#include <vector>

#include "tests/policy/apps/programs.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

/// The commands in the first block of a README.
std::string commands_of(const fs::path& readme) {
  const std::string text = content(readme);
  const std::size_t begin = text.find("```sh\n") + 6;
  return text.substr(begin, text.find("```", begin) - begin);
}

class Init : public Programs {
 protected:
  int shell(const std::string& commands) { return start(fs::path("/bin/sh"), {"-e", "-c", commands}).wait(kPatience); }
};

TEST_F(Init, MakesAFolderWhoseTwoCommandsPassAtOnceFromAnywhere) {
  const support::TemporaryFolder elsewhere;
  const fs::path own = elsewhere.path() / "own";
  ASSERT_EQ(run("init " + own.string() + " --speed-mps 2.5 --depth-m 100"), 0) << content(folder / "err");
  const std::string commands = commands_of(own / "README.md");
  EXPECT_EQ(std::ranges::count(commands, '\n'), 2) << commands;
  ASSERT_EQ(shell(commands), 0) << commands << content(folder / "err");
  EXPECT_TRUE(fs::exists(own / "flight/report.html"));
  EXPECT_NE(content(own / "flight/summary.json").find("\"steps\""), std::string::npos);
  EXPECT_TRUE(files().empty());
}

TEST_F(Init, FliesAnAreaOfAnotherSizeByAPolicyOfItsOwn) {
  const fs::path own = folder / "own area";  // whose name a shell takes apart
  ASSERT_EQ(start(EARSHOT_BIN_DIR "/earshot-init", {own.string(), "--area-north-m", "9000", "--area-east-m", "12000"}).wait(kPatience), 0)
      << content(folder / "err");
  ASSERT_EQ(shell(commands_of(own / "README.md")), 0) << content(folder / "err");
  EXPECT_TRUE(fs::exists(own / "flight/report.html"));
}

TEST_F(Init, SaysWhichCommandMakesTablesWhereNoneThatShipAreOfTheSearch) {
  ASSERT_EQ(run("init own --depth-m 450 --frequency-hz 50"), 0) << content(folder / "err");
  const std::string made = EARSHOT_BIN_DIR "/earshot tables " + (folder / "own/ocean.toml").string();
  EXPECT_NE(content(folder / "out")
                .find("\nto be made first:\n  " + made + " \\\n    -o " + (folder / "own/search.tables").string() + " \\\n    --key " +
                      (folder / "own/search.key").string() + " \\\n    --vehicle-depth-m 450.0 --furthest-m 35356.0\n"),
            std::string::npos)
      << content(folder / "out");
  const std::string commands = commands_of(folder / "own/README.md");
  ASSERT_TRUE(commands.starts_with(made)) << commands;
  EXPECT_EQ(shell(commands.substr(commands.find('\n') + 1)), 2);
  EXPECT_NE(content(folder / "err").find("search.tables"), std::string::npos) << content(folder / "err");
  ASSERT_EQ(shell(commands), 0) << commands << content(folder / "err");
  EXPECT_TRUE(fs::exists(folder / "own/flight/report.html"));
}

TEST_F(Init, AsksForWhatAKilometreTakesOfABatteryAndCheckDoubtsItAsLongAsItIsNotSaid) {
  ASSERT_EQ(run("init own --battery-percent 20"), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"your", "vehicle's", "battery_percent_per_km"})) << content(folder / "out");
  EXPECT_EQ(shell("own/run --check"), 0) << content(folder / "err");
  const std::string open = content(folder / "out");
  EXPECT_TRUE(support::has_line(open, {"not known", "vehicle.battery_percent_per_km", "not"})) << open;
  EXPECT_TRUE(support::has_line(open, {"whether", "battery", "lasts", "not"})) << open;
  ASSERT_EQ(run("init said --battery-percent 20 --battery-percent-per-km 0.4"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "out").find("battery"), std::string::npos) << content(folder / "out");
  EXPECT_EQ(shell("said/run --check"), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"40.0 %", "battery", "still"})) << content(folder / "out");
  refuses("init other --battery-percent-per-km 0.4", {"--battery-percent-per-km requires --battery-percent"});
}

TEST_F(Init, BelievesInTablesOfOnesOwnWhereThatIsAskedFor) {
  ASSERT_EQ(run("init own --own-tables"), 0) << content(folder / "err");
  const std::string commands = commands_of(folder / "own/README.md");
  ASSERT_EQ(shell(commands.substr(0, commands.rfind('\n', commands.size() - 2))), 0)
      << commands << content(folder / "err");  // all but the flight
  EXPECT_TRUE(fs::exists(folder / "own/search.tables"));
}

TEST_F(Init, RunFileStartsTheVehiclesProgramInItsFolderWhereverThatIsMovedTo) {
  ASSERT_EQ(run("init own"), 0) << content(folder / "err");
  fs::rename(folder / "own", folder / "my own");
  EXPECT_EQ(shell("'my own/run' --check"), 0) << content(folder / "err");
  EXPECT_FALSE(fs::exists(folder / "my own/journal")) << "it only judges";
}

TEST_F(Init, RefusesNumbersOutsideTheirRangeAndBusesThatAreNone) {
  refuses("init own --speed-mps 0", {"--speed-mps: 0: must be a number from 0.1 to 20"});
  refuses("init own --area-north-m 4000", {"--area-north-m: 4000: must be a number from 5000 to 35000"});
  refuses("init own --depth-m nan", {"--depth-m"});
  refuses("init own --lcm-url tcp://here", {"--lcm-url", "must be udpm://GROUP:PORT?ttl=N"});
  refuses("init own --bus can --can-interface a/b", {"--can-interface", "must be 1 to 15 characters"});
  refuses("init own --can-interface can1", {"--can-interface: needs --bus can, or mixed"});
}

}  // namespace
}  // namespace earshot::policy_programs
