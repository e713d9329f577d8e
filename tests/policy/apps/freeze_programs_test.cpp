// earshot freeze as a person meets it.
#include <string>
#include <vector>

#include "tests/policy/apps/programs.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::policy_programs {
namespace {

TEST_F(Programs, FreezeRefusesBadInputInOneLine) {
  ASSERT_EQ(run("train" + kOcean + " --episodes 1 -o a.checkpoint"), 0);
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  std::ofstream(folder / "cut.checkpoint") << content(folder / "a.checkpoint").substr(0, 1'000);
  support::write_secret_file(folder / "word.key", "swordfish\n");
  support::write_secret_file(folder / "open.key", std::string(64, '7') + "\n");
  fs::permissions(folder / "open.key", fs::perms::others_read, fs::perm_options::add);
  const std::string key = content(folder / "a.key");
  refuses("freeze none.checkpoint -o a.policy --key a.key", {"none.checkpoint", "no such file"});
  refuses("freeze cut.checkpoint -o a.policy --key a.key", {"cut.checkpoint", "cut short"});
  refuses("freeze a.checkpoint -o a.policy --key none.key", {"none.key", "--new-key"});
  refuses("freeze a.checkpoint -o a.policy --key word.key", {"word.key", "64 hexadecimal digits"});
  refuses("freeze a.checkpoint -o a.policy --key open.key", {"open.key", "chmod 600 open.key"});
  refuses("freeze a.checkpoint -o a.policy --key a.key --new-key", {"a.key", "exists"});
  refuses("freeze a.checkpoint -o nowhere/a.policy --key a.key", {"nowhere/a.policy", "cannot be written"});
  refuses("freeze a.checkpoint --key a.key", {"MODEL", "--output"});
  refuses("freeze a.checkpoint -o a.policy --key a.key --draw dice", {"--draw", "dice"});
  refuses("freeze a.checkpoint -o ./a.key --key a.key", {"--key a.key", "--output ./a.key", "the same file"});
  refuses("freeze a.checkpoint -o a.pub --key a.key", {"--key a.pub", "--output a.pub", "the same file"});
  refuses("freeze a.checkpoint -o b.key --key b.key --new-key", {"--key b.key", "--output b.key", "the same file"});
  EXPECT_EQ(content(folder / "a.key"), key);
}

TEST_F(Programs, FreezeRefusesToReplaceTheModelThatItReadsAlsoByALink) {
  fs::copy_file(kFixedSource, folder / "a.policy");
  fs::create_symlink("a.policy", folder / "link.policy");
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  const std::string model = content(folder / "a.policy");
  refuses("freeze a.policy -o ./a.policy --key a.key", {"MODEL a.policy", "--output ./a.policy", "the same file"});
  refuses("freeze link.policy -o a.policy --key a.key", {"MODEL link.policy", "--output a.policy", "the same file"});
  refuses("freeze a.policy -o link.policy --key a.key", {"MODEL a.policy", "--output link.policy", "the same file"});
  EXPECT_EQ(content(folder / "a.policy"), model);
  fs::copy_file(kSource + "/tests/policy/freeze/models/memory.zip", folder / "a.zip");
  refuses("freeze a.zip -o a.zip --key a.key --force", {"MODEL a.zip", "--output a.zip", "the same file"});
  fs::create_hard_link(folder / "a.zip", folder / "hard.policy");
  refuses("freeze a.zip -o hard.policy --key a.key --force", {"MODEL a.zip", "--output hard.policy", "the same file"});
  fs::copy_file(kSource + "/policy/ppo/runs/shipped.toml", folder / "run.toml");
  refuses("freeze run.toml -o run.toml --key a.key --force", {"MODEL run.toml", "--output run.toml", "the same file"});
  std::ofstream(folder / "search.json") << "{}";
  refuses("freeze a.zip --search search.json -o search.json --key a.key --force", {"--search search.json", "the same file"});
}

TEST_F(Programs, FreezeMakesAPolicyAnewInItsPlaceWhenForced) {
  fs::copy_file(kFixedSource, folder / "old.policy");
  ASSERT_EQ(run("freeze old.policy -o old.policy --force --key a.key --new-key"), 0) << content(folder / "err");
  ASSERT_EQ(run("freeze old.policy -o kept.policy --key a.key"), 0) << content(folder / "err");
}

/// The run of the policy that ships: a file of a few kilobytes that flies the belief's own advice.
TEST_F(Programs, FreezeMakesAPolicyWithoutANetworkOfARunFile) {
  const std::string run_file = kSource + "/policy/ppo/runs/shipped.toml";
  ASSERT_EQ(run("freeze " + run_file + " -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("argmax"), std::string::npos) << content(folder / "out");
  const std::string bytes = content(folder / "a.policy");
  for (const char* line : {"run = shipped.toml\n", "network = none: the belief's own advice\n", "source = changing\n"})
    EXPECT_NE(bytes.find(line), std::string::npos) << line;
  ASSERT_EQ(run("freeze " + run_file + " -o b.policy --key a.key --draw sampled --listening mean --listening-window-s 30"), 0)
      << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("sampled"), std::string::npos);
  EXPECT_TRUE(support::has_line(content(folder / "b.policy"), {"listening", "mean", "30 s", "before", "newest"}));
  ASSERT_EQ(run("evaluate a.policy --episodes 5" + kOcean), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "err"), "") << "its task is that of its run";
}

TEST_F(Programs, FreezeRefusesARunFileWhoseStateIsNoBeliefAndASearchBesideIt) {
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  refuses("freeze " + kSource + "/policy/ppo/runs/fixed_source.toml -o a.policy --key a.key",
          {"fixed_source.toml: state = \"simple\"", "must have \"belief\""});
  std::ofstream(folder / "search.json") << "{}";
  refuses("freeze " + kSource + "/policy/ppo/runs/shipped.toml -o a.policy --key a.key --search search.json", {"--search", "run file"});
  std::ofstream(folder / "bad.toml") << "state = \"belief\"\nseeed = 1\n";
  refuses("freeze bad.toml -o a.policy --key a.key", {"bad.toml:2: seeed"});
  EXPECT_FALSE(fs::exists(folder / "a.policy"));
}

TEST_F(Programs, FreezeLeavesNoSecretHalfWhosePublicHalfCannotBeWritten) {
  fs::create_symlink("nowhere/a.pub", folder / "a.pub");  // not there, so that nothing seems to be replaced
  refuses("freeze --key a.key --new-key", {"a.pub", "cannot be written"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.pub"}));
}

TEST_F(Programs, FreezeMakesOneOfTwoKeysThatAreAskedForAtOnce) {
  for (int i = 0; i < 10; ++i) {
    fs::remove(folder / "a.key");
    fs::remove(folder / "a.pub");
    const std::string freeze = "freeze --key a.key --new-key";
    support::Process first = start(freeze);
    support::Process second = start(freeze);
    const int statuses = first.wait(kPatience) + second.wait(kPatience);
    EXPECT_EQ(statuses, 0 + 2) << "one is refused";
    EXPECT_EQ(files(), (std::vector<std::string>{"a.key", "a.pub"}));
  }
}

TEST_F(Programs, FreezeNamesTheModelWhoseProvenanceIsTooLong) {
  const auto long_name = [](char letter) { return std::string(230, letter); };
  const std::string model = long_name('a') + ".checkpoint";
  ASSERT_EQ(run("train" + kOcean + " --episodes 1 -o " + model + " --curve " + long_name('b') + ".csv --plot " + long_name('c') + ".svg"),
            0)
      << content(folder / "err");
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  refuses("freeze " + model + " -o a.policy --key a.key", {model + ": provenance: longer than the 1024 bytes a policy can hold"});
}

TEST_F(Programs, FreezeReplacesThePublicKeyWhoseSecretHalfIsGoneWhenForced) {
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0) << content(folder / "err");
  const std::string public_key = content(folder / "a.pub");
  fs::remove(folder / "a.key");
  refuses("freeze --key a.key --new-key", {"a.pub", "--force"});
  EXPECT_EQ(content(folder / "a.pub"), public_key);
  ASSERT_EQ(run("freeze --key a.key --new-key --force"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "a.pub"), public_key);
}

TEST_F(Programs, FreezeSignsWithNoPublicKeyAndNotBesideAnothersPublicHalf) {
  const std::string models = kSource + "/tests/policy/freeze/models/";
  const std::string freeze = "freeze " + models + "memory.onnx -o a.policy --key ";
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0) << content(folder / "err");
  ASSERT_EQ(run("freeze --key b.key --new-key"), 0) << content(folder / "err");
  refuses(freeze + "a.pub", {"a.pub", "a secret key must not end in .pub"});
  fs::copy_file(folder / "b.pub", folder / "a.pub", fs::copy_options::overwrite_existing);
  refuses(freeze + "a.key", {"a.pub", "is not the public half of a.key"});
  EXPECT_FALSE(fs::exists(folder / "a.policy"));
}

TEST_F(Programs, FreezeWritesTheLostPublicHalfOfAKeyAgain) {
  const std::string models = kSource + "/tests/policy/freeze/models/";
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0) << content(folder / "err");
  const std::string public_key = content(folder / "a.pub");
  fs::remove(folder / "a.pub");
  ASSERT_EQ(run("freeze " + models + "memory.onnx -o a.policy --key a.key"), 0) << content(folder / "err");
  EXPECT_TRUE(support::has_line(content(folder / "out"), {"a.pub", "public half", "vehicle", "needs", "missing"}));
  ASSERT_EQ(run("freeze --key a.key --public-key"), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "a.pub"), public_key);
}

TEST_F(Programs, FreezeReadsModelsTrainedElsewhere) {
  const std::string models = kSource + "/tests/policy/freeze/models/";
  ASSERT_EQ(run("freeze " + models + "memory.zip -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "a.policy").find("trained_by = stable-baselines3 2.3.2 PPO"), std::string::npos);
  EXPECT_EQ(run("freeze " + models + "memory.onnx -o b.policy --key a.key --draw argmax"), 0) << content(folder / "err");
  EXPECT_EQ(run("evaluate b.policy" + kOcean + " --episodes 5"), 0) << content(folder / "err");
}

/// As torch.onnx.export of 2.9 writes them.
TEST_F(Programs, FreezeReadsAnOnnxModelWhoseWeightsStandBesideIt) {
  const std::string models = kSource + "/tests/policy/freeze/models/";
  ASSERT_EQ(run("freeze " + models + "external.onnx -o a.policy --key a.key --new-key"), 0) << content(folder / "err");
  // CRC-32 of both files, one after the other: cat external.onnx external.onnx.data | gzip -c | tail -c8 | od -An -tx4 -N4
  EXPECT_NE(content(folder / "a.policy").find("model_crc32 = 9e53bd85\n"), std::string::npos);
  fs::copy_file(models + "external.onnx", folder / "alone.onnx");
  refuses("freeze alone.onnx -o b.policy --key a.key",
          {"alone.onnx: initializer 0.weight: its weights are in external.onnx.data", "not beside the model"});
  EXPECT_FALSE(fs::exists(folder / "b.policy"));
}

TEST_F(Programs, FreezeRefusesModelsItCannotBeSureOfInOneLine) {
  const std::string models = kSource + "/tests/policy/freeze/models/";
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  std::ofstream(folder / "cut.zip", std::ios::binary) << content(models + "memory.zip").substr(0, 20'000);
  std::ofstream(folder / "text.onnx") << "swordfish\n";
  std::ofstream(folder / "bad.json") << "{}\n";
  const auto refuses_model = [&](const std::string& words, std::initializer_list<std::string> parts) {
    refuses("freeze " + words + " -o a.policy --key a.key", parts);
  };
  refuses_model("cut.zip", {"cut.zip", "cut short"});
  refuses_model("text.onnx", {"text.onnx"});
  refuses_model(models + "continuous.zip", {"continuous.zip", "action_space"});
  refuses_model(models + "own_policy.zip", {"own_policy.zip", "policy_class"});
  refuses_model(models + "documented.onnx", {"documented.onnx", "earshot.gym.sb3.save or export_onnx", "--search"});
  refuses_model(models + "plain_save.zip", {"plain_save.zip", "earshot.gym.sb3.save or export_onnx", "--search"});
  refuses_model(models + "plain_save.zip --search bad.json", {"plain_save.zip", "search description"});
  refuses_model(models + "memory.zip --search bad.json", {"memory.zip", "--search"});
}

}  // namespace
}  // namespace earshot::policy_programs
