// The commands as a person meets them: what they make, and what they say of bad input.
#include <csignal>
#include <functional>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "tests/policy/apps/programs.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

using namespace std::chrono_literals;

nlohmann::json parameters_in(const fs::path& checkpoint) {
  const std::string text = content(checkpoint);
  return nlohmann::json::parse(text.substr(0, text.find('\n')))["parameters"];
}

/// Changes what a checkpoint says, and its checksum with it.
void rewrite(const fs::path& checkpoint, const std::function<void(nlohmann::ordered_json&)>& change) {
  const std::string text = content(checkpoint);
  auto json = nlohmann::ordered_json::parse(text.substr(0, text.find('\n')));
  change(json);
  const std::string line = json.dump();
  const std::uint32_t crc = crc32({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()});
  std::ofstream(checkpoint) << line << "\ncrc32 " << std::hex << std::setw(8) << std::setfill('0') << crc << '\n';
}

/// Makes of a checkpoint one of the programs that did not yet keep where its curve is.
void forget_the_curve(const fs::path& checkpoint) {
  rewrite(checkpoint, [](auto& json) { EXPECT_EQ(json["continuation"].erase("curve"), 1U); });
}

TEST_F(Programs, TrainFreezeAndEvaluateMakeAPolicyThatFlies) {
  ASSERT_EQ(run("train" + kOcean + " --episodes 40 --seed 3 -o a.checkpoint"), 0) << content(folder / "err");
  const std::string curve = content(folder / "a.csv");
  EXPECT_EQ(curve.substr(0, curve.find('\n')), "episode,steps,reward,found");
  EXPECT_GE(std::ranges::count(curve, '\n'), 41) << "whole rollouts";
  ASSERT_EQ(run("freeze a.checkpoint -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_EQ(fs::status(folder / "a.key").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(run("evaluate a.policy" + kOcean + " --episodes 20 --json a.json"), 0) << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["episodes"], 20);
  ASSERT_EQ(json["results"].size(), 1U);
  EXPECT_EQ(json["results"][0]["policy"], "a.policy");
  EXPECT_EQ(files(), (std::vector<std::string>{"a.checkpoint", "a.csv", "a.json", "a.key", "a.policy", "a.pub", "a.updates.csv"}));
}

TEST_F(Programs, TrainMakesTheSameCheckpointFromTheSameSeed) {
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  const std::string first = content(folder / "a.checkpoint");
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  EXPECT_EQ(content(folder / "a.checkpoint"), first);
}

TEST_F(Programs, FreezeWritesIntoTheProvenanceWhereThePolicyComesFrom) {
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint"), 0);
  ASSERT_EQ(run("freeze a.checkpoint -o a.policy --key a.key --new-key"), 0);
  const std::string bytes = content(folder / "a.policy");
  for (const std::string part : {"command = earshot-train --environment", "commit = ", "environment = munk_flat.toml",
                                 "environment_crc32 = ", "seed = 3", "learning_rate = 0.0003"}) {
    EXPECT_NE(bytes.find(part), std::string::npos) << part;
  }
}

TEST_F(Programs, TrainGoesOnWhereACheckpointStandsAndEndsWithTheSameBytes) {
  const std::string task = kOcean + " --state memory --source changing --steps 20480 --seed 3 --checkpoint-every 4096 -o a.checkpoint";
  ASSERT_EQ(run("train" + task), 0) << content(folder / "err");
  const std::vector<std::string> whole{content(folder / "a.checkpoint"), content(folder / "a.csv"), content(folder / "a.updates.csv")};
  fs::remove(folder / "a.checkpoint");
  {
    support::Process train = start("train" + task);
    while (!fs::exists(folder / "a.checkpoint") && train.wait(10ms) < 0) {
    }
    train.signal(SIGKILL);
    EXPECT_EQ(train.wait(kPatience), 128 + SIGKILL) << "it was to be killed before its end";
  }
  EXPECT_NE(content(folder / "a.checkpoint"), whole[0]);
  std::ofstream(folder / "a.csv", std::ios::app) << "7,7";  // as if killed between two files: the curve tells of more than the checkpoint
  ASSERT_EQ(run("train --resume a.checkpoint"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "a.checkpoint"), whole[0]);
  EXPECT_EQ(content(folder / "a.csv"), whole[1]);
  EXPECT_EQ(content(folder / "a.updates.csv"), whole[2]);
  ASSERT_EQ(run("train --resume a.checkpoint --steps 22528"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "a.csv").substr(0, whole[1].size()), whole[1]);
}

/// Two worlds, one of them six times as noisy as the other, in a folder `train`.
void write_worlds(const fs::path& folder) {
  fs::create_directory(folder / "train");
  for (const std::string seed : {"1", "2"}) {
    std::ofstream(folder / ("train/world" + seed + ".toml"))
        << "name = \"world" << seed << "\"\nwhat = \"noise\"\nseed = " << seed << "\nenvironment = \"" << kSource
        << "/sim/ocean/environments/munk_flat.toml\"\n[conditions]\nfluctuation_db = " << (seed == "1" ? 1 : 6) << ".0\nfloor_db = 3.0\n";
  }
}

TEST_F(Programs, TrainGoesOnInTheWorldsThatItDrewItsEpisodesFrom) {
  write_worlds(folder);
  const std::string task = kOcean + " --state memory --source changing --seed 3 --environments 4";
  ASSERT_EQ(run("train" + task + " --world train --steps 16384 -o whole.checkpoint"), 0) << content(folder / "err");
  ASSERT_EQ(run("train" + task + " --world train --steps 8192 -o a.checkpoint"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "a.checkpoint").find(R"("worlds":"2")"), std::string::npos);
  ASSERT_EQ(run("train --resume a.checkpoint --steps 16384"), 0) << content(folder / "err");
  EXPECT_EQ(parameters_in(folder / "a.checkpoint"), parameters_in(folder / "whole.checkpoint"));
  EXPECT_EQ(content(folder / "a.csv"), content(folder / "whole.csv"));
  ASSERT_EQ(run("train" + task + " --world train/world1.toml --steps 16384 -o one.checkpoint"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "one.csv"), content(folder / "whole.csv"));
  std::ofstream(folder / "train/world2.toml", std::ios::app) << "source_speed_mps = 0.5\n";
  refuses("train --resume a.checkpoint --steps 32768", {"a.checkpoint", "one of its worlds"});
}

TEST_F(Programs, TrainWritesItsCheckpointWhenInterrupted) {
  support::Process train = start("train" + kOcean + " --steps 100000000 --checkpoint-every 4096 -o a.checkpoint --plot a.svg");
  while (!fs::exists(folder / "a.checkpoint") && train.wait(10ms) < 0) {
  }
  train.signal(SIGINT);
  EXPECT_EQ(train.wait(kPatience), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("--resume"), std::string::npos);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.checkpoint", "a.csv", "a.svg", "a.updates.csv"}));
  const auto steps = std::ranges::count(content(folder / "a.updates.csv"), '\n') * 2'048;
  ASSERT_EQ(run("train --resume a.checkpoint --steps " + std::to_string(steps)), 0) << content(folder / "err");
  EXPECT_EQ(std::ranges::count(content(folder / "a.updates.csv"), '\n') * 2'048, steps + 2'048) << "one rollout more, and the header";
}

TEST_F(Programs, TrainMakesOfSeveralSeedsAtOnceWhatItMakesOfEach) {
  ASSERT_EQ(run("train" + kOcean + " --steps 4096 --seed 2 -o alone.checkpoint"), 0);
  ASSERT_EQ(run("train" + kOcean + " --steps 4096 --seeds 1-3 -o a.checkpoint --plot a.svg"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "a.seed2.csv"), content(folder / "alone.csv"));
  EXPECT_EQ(parameters_in(folder / "a.seed2.checkpoint"), parameters_in(folder / "alone.checkpoint"));
  EXPECT_NE(parameters_in(folder / "a.seed1.checkpoint"), parameters_in(folder / "alone.checkpoint"));
  EXPECT_NE(content(folder / "out").find("median of 3 trainings"), std::string::npos);
  EXPECT_TRUE(support::has_line(content(folder / "a.svg"), {"training", "3 seeds"}));
  ASSERT_EQ(run("train --resume a.seed1.checkpoint a.seed2.checkpoint --steps 6144"), 0) << content(folder / "err");
  ASSERT_EQ(run("train --resume alone.checkpoint --steps 6144"), 0) << content(folder / "err");
  EXPECT_EQ(parameters_in(folder / "a.seed2.checkpoint"), parameters_in(folder / "alone.checkpoint"));
}

TEST_F(Programs, TrainGivesEverySeedItsOwnFilesWhateverTheOutputIsCalled) {
  ASSERT_EQ(run("train" + kOcean + " --seeds 1,2 --episodes 1 -o x"), 0) << content(folder / "err");
  EXPECT_EQ(files(),
            (std::vector<std::string>{"x.seed1", "x.seed1.csv", "x.seed1.updates.csv", "x.seed2", "x.seed2.csv", "x.seed2.updates.csv"}));
  const std::string curve = content(folder / "x.seed1.csv");
  EXPECT_NE(content(folder / "x.seed2.csv"), curve);
  ASSERT_EQ(run("train --resume x.seed1 x.seed2 --steps 4096"), 0) << content(folder / "err");
  EXPECT_EQ(files().size(), 6U) << "it went on with the same files";
  EXPECT_EQ(content(folder / "x.seed1.csv").substr(0, curve.size()), curve);
  EXPECT_GT(content(folder / "x.seed1.csv").size(), curve.size());
}

TEST_F(Programs, TrainTakesTheLastSeedThereIs) {
  ASSERT_EQ(run("train" + kOcean + " --seeds 18446744073709551615 --steps 1 -o x"), 0) << content(folder / "err");
  EXPECT_EQ(files().front(), "x.seed18446744073709551615");
}

TEST_F(Programs, TrainGoesOnFromTheCurveThatItWasGivenAndIntoTheFilesThatItIsGiven) {
  fs::create_directories(folder / "curves");
  ASSERT_EQ(run("train" + kOcean + " --steps 4096 --seed 3 -o whole.checkpoint"), 0) << content(folder / "err");
  ASSERT_EQ(run("train" + kOcean + " --steps 2048 --seed 3 -o a.checkpoint --curve curves/c.csv"), 0) << content(folder / "err");
  const std::string first = content(folder / "curves/c.csv");
  const std::string checkpoint = content(folder / "a.checkpoint");

  ASSERT_EQ(run("train --resume a.checkpoint --steps 4096 -o b.checkpoint"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "b.csv"), content(folder / "whole.csv"));
  EXPECT_EQ(content(folder / "b.updates.csv"), content(folder / "whole.updates.csv"));
  EXPECT_EQ(content(folder / "curves/c.csv"), first) << "what it went on from stays as it was";
  EXPECT_EQ(content(folder / "a.checkpoint"), checkpoint);
  ASSERT_EQ(run("train --resume b.checkpoint --steps 6144"), 0) << content(folder / "err");

  ASSERT_EQ(run("train --resume a.checkpoint --steps 4096 --curve d.csv"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "d.csv"), content(folder / "whole.csv"));
  ASSERT_EQ(run("train --resume a.checkpoint --steps 6144"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "d.csv"), content(folder / "b.csv"));
  EXPECT_FALSE(fs::exists(folder / "a.csv"));

  fs::remove(folder / "d.csv");
  refuses("train --resume a.checkpoint", {"d.csv", "no such file"});
}

TEST_F(Programs, TrainGoesOnFromACheckpointThatDoesNotSayWhereItsCurveIs) {
  for (const std::string curve : {"", " --curve c.csv"}) {
    ASSERT_EQ(run("train" + kOcean + " --steps 2048 -o a.checkpoint" + curve), 0) << content(folder / "err");
    const fs::path file = folder / (curve.empty() ? "a.csv" : "c.csv");
    const std::string first = content(file);
    forget_the_curve(folder / "a.checkpoint");
    ASSERT_EQ(run("train --resume a.checkpoint --steps 4096"), 0) << content(folder / "err");
    EXPECT_EQ(content(file).substr(0, first.size()), first);
    EXPECT_GT(content(file).size(), first.size());
  }
}

TEST_F(Programs, TrainThatDivergesSaysSoAndLeavesItsGoodFilesAlone) {
  ASSERT_EQ(run("train --steps 2048 -o a.checkpoint" + kOcean), 0) << content(folder / "err");
  // Settings that are allowed do not diverge at once: weights that are about to overflow do.
  rewrite(folder / "a.checkpoint", [](auto& json) {
    for (auto& weight : json["parameters"]) weight = 3e38;
  });
  const std::vector<std::string> good{content(folder / "a.checkpoint"), content(folder / "a.csv"), content(folder / "a.updates.csv")};
  EXPECT_EQ(run("train --resume a.checkpoint --steps 4096"), 2);
  EXPECT_NE(content(folder / "err").find("a.checkpoint: diverged at step "), std::string::npos) << content(folder / "err");
  EXPECT_NE(content(folder / "err").find("lower learning_rate"), std::string::npos) << content(folder / "err");
  EXPECT_TRUE(content(folder / "a.checkpoint") == good[0]);
  EXPECT_EQ(content(folder / "a.csv"), good[1]);
  EXPECT_EQ(content(folder / "a.updates.csv"), good[2]);
}

TEST_F(Programs, TrainStartsInsideTheBorderOfTheWidthThatTheCommandLineGives) {
  std::ofstream(folder / "run.toml") << "[search]\nstart = \"inside_border\"\nborder_width_m = 1000.0\n";
  ASSERT_EQ(run("train run.toml" + kOcean + " --border-width-m 4000 --steps 1 -o a.checkpoint"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "a.checkpoint").find(R"("start_margin_m":"4000")"), std::string::npos);
  ASSERT_EQ(run("train run.toml" + kOcean + " --border-width-m 4000 --start-margin-m 3000 --steps 1 -o b.checkpoint"), 0);
  EXPECT_NE(content(folder / "b.checkpoint").find(R"("start_margin_m":"3000")"), std::string::npos);
}

TEST_F(Programs, TrainSaysThatNoEpisodeHasEndedRatherThanThatItEarnedNothing) {
  std::ofstream(folder / "run.toml") << "[ppo]\nsteps_per_rollout = 2\nbatch_size = 2\n";
  ASSERT_EQ(run("train run.toml" + kOcean + " --source changing --start-margin-m 12000 --steps 1 --seed 3 -o a.checkpoint"), 0)
      << content(folder / "err");
  ASSERT_EQ(content(folder / "a.csv"), "episode,steps,reward,found\n") << "this seed is to find nothing in two steps";
  EXPECT_NE(content(folder / "out").find("no episode has ended"), std::string::npos) << content(folder / "out");
  EXPECT_EQ(content(folder / "err").find("median reward"), std::string::npos) << "progress is for terminals: " << content(folder / "err");
}

TEST_F(Programs, TrainOnTwoMpiRanksIsTheSameEveryTimeAndGoesOn) {
  if (std::string(EARSHOT_MPIEXEC).empty()) GTEST_SKIP() << "built without MPI";
  auto train = [this](const std::string& words) {
    return run("train " + words, EARSHOT_MPIEXEC " --allow-run-as-root --oversubscribe -n 2");
  };
  ASSERT_EQ(train(kOcean + " --steps 12288 --seed 3 -o a.checkpoint"), 0) << content(folder / "err");
  const auto parameters = parameters_in(folder / "a.checkpoint");
  const std::string curve = content(folder / "a.csv");
  ASSERT_EQ(train(kOcean + " --steps 8192 --seed 3 -o b.checkpoint"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "b.csv"), curve.substr(0, content(folder / "b.csv").size()));
  refuses("train --resume b.checkpoint --steps 12288", {"b.checkpoint", "2 ranks"});
  ASSERT_EQ(train("--resume b.checkpoint --steps 12288"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "b.csv"), curve);
  EXPECT_EQ(parameters_in(folder / "b.checkpoint"), parameters);
  const std::string updates = content(folder / "a.updates.csv");
  EXPECT_EQ(std::ranges::count(updates, '\n'), 4) << "three rollouts of 2048 steps on each of two ranks";

  ASSERT_EQ(run("train" + kOcean + " --steps 12288 --seed 3 -o c.checkpoint"), 0);
  EXPECT_NE(parameters_in(folder / "c.checkpoint"), parameters) << "the second rank had no say";
  EXPECT_EQ(train(kOcean + " --steps 2048 -o nowhere/a.checkpoint"), 2);
  EXPECT_NE(content(folder / "err").find("nowhere/a.checkpoint: cannot be written"), std::string::npos);
}

TEST_F(Programs, TrainRefusesToGoOnWithWhatItCannotInOneLine) {
  std::ofstream(folder / "run.toml") << "environment = \"" << kSource << "/sim/ocean/environments/munk_flat.toml\"\nsteps = 2048\n";
  ASSERT_EQ(run("train run.toml -o a.checkpoint"), 0) << content(folder / "err");
  const std::string whole = content(folder / "a.checkpoint");
  std::ofstream(folder / "cut.checkpoint") << whole.substr(0, whole.size() / 2);
  std::ofstream(folder / "old.checkpoint") << R"({"format":"earshot checkpoint 2"})" << '\n';
  refuses("train --resume none.checkpoint", {"none.checkpoint", "no such file"});
  refuses("train --resume cut.checkpoint", {"cut.checkpoint", "cut short"});
  refuses("train --resume old.checkpoint", {"old.checkpoint", "another version"});
  refuses("train --resume a.checkpoint --seed 4", {"--seed", "--resume"});
  refuses("train run.toml --resume a.checkpoint", {"RUN", "--resume"});
  refuses("train run.toml --seeds 3-1 -o a.checkpoint", {"--seeds", "3-1"});
  refuses("train run.toml --seeds 1-1001 -o a.checkpoint", {"--seeds", "1000", "1-1001"});
  refuses("train run.toml --seeds 1-1000,2000 -o a.checkpoint", {"--seeds", "1000", "1-1000,2000"});
  refuses("train --resume a.checkpoint a.checkpoint", {"--resume a.checkpoint, --resume a.checkpoint", "the same file"});
  refuses("train run.toml -o b.checkpoint --plot b.pdf", {"--plot", "b.pdf", ".png"});
  std::ofstream(folder / "a.csv", std::ios::in) << "episode,steps,reward,fount";
  refuses("train --resume a.checkpoint", {"a.csv", "not the learning curve"});
  ASSERT_EQ(run("train run.toml -o a.checkpoint"), 0);
  std::ofstream(folder / "run.toml", std::ios::app) << "seed = 2\n";
  refuses("train --resume a.checkpoint", {"a.checkpoint", "run file"});
}

TEST_F(Programs, TrainRefusesBadInputInOneLine) {
  std::ofstream(folder / "bad.toml") << "episode = 5\n";
  std::ofstream(folder / "ocean.toml") << content(kSource + "/sim/ocean/environments/munk_flat.toml") << "\n[sky]\n";
  refuses("train -o a.checkpoint", {"--environment"});
  refuses("train --environment none.toml -o a.checkpoint", {"none.toml", "no such file"});
  refuses("train --environment ocean.toml -o a.checkpoint", {"ocean.toml", "sky", "unknown key"});
  refuses("train none.toml -o a.checkpoint", {"none.toml", "no such file"});
  refuses("train bad.toml" + kOcean + " -o a.checkpoint", {"bad.toml:1", "episode", "unknown key"});
  refuses("train" + kOcean + " --episodes 1 -o nowhere/a.checkpoint", {"nowhere/a.checkpoint", "cannot be written"});
  refuses("train" + kOcean + " --state both -o a.checkpoint", {"--state", "both"});
  refuses("train" + kOcean + " --border-width-m -5 -o a.checkpoint", {"--border-width-m", "-5"});
  refuses("train" + kOcean + " --start inside_border --border-width-m 12500 -o a.checkpoint", {"--border-width-m"});
  refuses("train" + kOcean + " --vehicle-depth-m 3000 -o a.checkpoint", {"--vehicle-depth-m", "sea floor"});
  refuses("train" + kOcean + " --frobnicate -o a.checkpoint", {"frobnicate"});
  refuses("train" + kOcean, {"--output"});
  refuses("train" + kOcean + " -o a\xFF.checkpoint", {"the command line holds bytes that are not UTF-8"});
  refuses("train" + kOcean + " -o a.svg --plot ./a.svg", {"--output a.svg", "--plot ./a.svg", "the same file"});
  refuses("train" + kOcean + " -o a.csv", {"--output a.csv, the learning curve of --output a.csv", "the same file"});
  refuses("train" + kOcean + " -o a.updates.csv --curve a.csv", {"--output a.updates.csv", "losses beside --curve", "the same file"});
  refuses("train" + kOcean + " --world none.toml -o a.checkpoint", {"none.toml", "no such file"});
  refuses("train" + kOcean + " --world " + kSource + "/policy/worlds/rock.toml -o a.checkpoint", {"rock.toml", "judged"});
  std::ofstream(folder / "start.toml") << "[search]\nstart = \"domain\"\nstart_margin_m = 10.0\n";
  refuses("train start.toml" + kOcean + " -o a.checkpoint", {"start.toml:3", "start_margin_m", "start"});
}

TEST_F(Programs, LeaveFilesThatAreNoneOfTheirOwnUnlessForced) {
  const std::string notes = "[seabed]\ndepth_m = 3000\n";
  for (const char* name : {"notes.toml", "notes.svg"}) std::ofstream(folder / name) << notes;
  const std::string evaluate = "evaluate --policies oracle --episodes 1";
  for (const char* option : {" --json notes.toml", " --csv notes.toml", " --paths notes.toml", " --page notes.toml", " --plot notes.svg"})
    refuses(evaluate + option, {"is there already and is not", "--force"});
  const std::string train = "train" + kOcean + " --episodes 1 -o ";
  refuses(train + "notes.toml", {"notes.toml: is there already and is not a checkpoint"});
  refuses(train + "a.checkpoint --curve notes.toml", {"notes.toml: is there already and is not a learning curve"});
  ASSERT_EQ(run(train + "a.checkpoint"), 0) << content(folder / "err");
  ASSERT_EQ(run(train + "a.checkpoint"), 0) << "its own kind: " << content(folder / "err");
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0) << content(folder / "err");
  refuses("freeze a.checkpoint -o notes.toml --key a.key", {"notes.toml: is there already and is not a .policy file"});
  EXPECT_EQ(content(folder / "notes.toml"), notes);
  ASSERT_EQ(run(evaluate + " --force --csv notes.toml"), 0) << content(folder / "err");
  EXPECT_TRUE(content(folder / "notes.toml").starts_with("world,policy,"));
}

TEST_F(Programs, SayNothingWithQuietAndMoreWithVerbose) {
  struct Case {
    std::string words;
    std::vector<std::string> only_verbose;
  };
  const std::vector<Case> cases{
      {"train" + kOcean + " --steps 2048 -o a.checkpoint",
       {"1 training, 1 at a time, 1 process", "munk_flat.toml", "learning_rate = 0.0003"}},
      {"freeze a.checkpoint -o a.policy --key a.key", {"source = fixed", "a vehicle trusts a.pub"}},
      {"evaluate a.policy --policies oracle --episodes 3", {"source = fixed", "munk_flat.toml", "--policies oracle", "took "}}};
  ASSERT_EQ(run("freeze --key a.key --new-key --quiet"), 0);
  EXPECT_EQ(content(folder / "out") + content(folder / "err"), "");
  for (const Case& c : cases) {
    ASSERT_EQ(run(c.words + " --quiet"), 0) << content(folder / "err");
    EXPECT_EQ(content(folder / "out") + content(folder / "err"), "") << c.words;
    ASSERT_EQ(run(c.words), 0) << content(folder / "err");
    const std::string said = content(folder / "out") + content(folder / "err");
    ASSERT_EQ(run(c.words + " --verbose"), 0) << content(folder / "err");
    for (const std::string& part : c.only_verbose) {
      EXPECT_EQ(said.find(part), std::string::npos) << part;
      EXPECT_NE(content(folder / "err").find(part), std::string::npos) << part << " is not in: " << content(folder / "err");
    }
  }
}

TEST_F(Programs, HelpExplainsItselfAndEndsWell) {
  for (const std::string verb : {"train", "evaluate", "freeze"}) {
    EXPECT_EQ(run(verb + " --help"), 0);
    EXPECT_NE(content(folder / "out").find("Example: earshot " + verb), std::string::npos);
  }
}

}  // namespace
}  // namespace earshot::policy_programs
