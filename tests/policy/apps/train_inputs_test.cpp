// What earshot train reads is never what it writes.

#include <fstream>

#include "tests/policy/apps/programs.hpp"

namespace earshot::policy_programs {
namespace {

/// With an ocean, a world and a run of the test's own.
class TrainInputs : public Programs {
 protected:
  TrainInputs() {
    write_ocean_with_section(folder / "ocean.toml", folder / "section.csv");
    std::ofstream(folder / "world.toml") << "name = \"own\"\nwhat = \"b\"\nseed = 1\nenvironment = \"ocean.toml\"\n";
    std::ofstream(folder / "run.toml") << "environment = \"ocean.toml\"\nsteps = 256\n";
  }
};

TEST_F(TrainInputs, AreReplacedByNoOutputNotEvenWhenForced) {
  fs::create_hard_link(folder / "section.csv", folder / "hard.svg");
  const std::string all = "train run.toml --force --world world.toml ";
  refuses(all + "-o run.toml", {"RUN run.toml, --output run.toml: the same file"});
  refuses(all + "-o ocean.toml", {"a file of the environment ocean.toml, --output ocean.toml: the same file"});
  refuses(all + "-o section.csv --curve c.csv", {"section.csv, --output section.csv: the same file"});
  refuses(all + "-o a.checkpoint --curve section.csv", {"section.csv, --curve section.csv: the same file"});
  refuses(all + "-o a.checkpoint --plot hard.svg", {"section.csv, --plot hard.svg: the same file"});
  refuses(all + "-o world.toml", {"a file of a world world.toml, --output world.toml: the same file"});
  fs::copy_file(kSource + "/policy/tables/shipped/20hz_300m.tables", folder / "own.tables");
  refuses("train run.toml --force --state belief --tables own.tables -o own.tables", {"ocean tables own.tables, --output own.tables"});
  EXPECT_TRUE(content(folder / "section.csv").starts_with("range_m"));
}

TEST_F(TrainInputs, OfATrainingThatIsGoneOnWithAreReplacedByItselfAlone) {
  ASSERT_EQ(run("train run.toml -o a.checkpoint"), 0) << content(folder / "err");
  fs::create_symlink("a.checkpoint", folder / "link.svg");
  refuses("train --resume a.checkpoint -o b.checkpoint --force --plot link.svg", {"--resume a.checkpoint, --plot link.svg: the same file"});
  refuses("train --resume a.checkpoint -o b.checkpoint --force --curve a.checkpoint", {"--resume a.checkpoint, --curve a.checkpoint"});
  refuses("train --resume a.checkpoint -o a.updates.csv --force --curve c.csv", {"the losses of --resume a.updates.csv, --output"});
  EXPECT_EQ(run("train --resume a.checkpoint --steps 512"), 0) << content(folder / "err");
  EXPECT_EQ(run("train --resume a.checkpoint --steps 768 -o b.checkpoint"), 0) << content(folder / "err");
}

}  // namespace
}  // namespace earshot::policy_programs
