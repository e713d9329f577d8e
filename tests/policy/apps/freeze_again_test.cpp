// A policy of another version of the format, from the refusal to the file that flies.
#include "tests/policy/apps/programs.hpp"

namespace earshot::policy_programs {
namespace {

const std::string kModels = kSource + "/tests/policy/freeze/models/";

TEST_F(Programs, FreezeAgainWithTheCommandThatARefusalNames) {
  fs::copy_file(kModels + "version_3_simple.policy", folder / "old.policy");
  ASSERT_EQ(run("freeze --key mine.key --new-key"), 0);
  ASSERT_EQ(run("evaluate old.policy --episodes 2" + kOcean), 2);
  const std::string refusal = content(folder / "err");
  const std::string before = "freeze it again, its weights as they are: earshot ";
  ASSERT_NE(refusal.find(before), std::string::npos) << refusal;
  std::string command = refusal.substr(refusal.find(before) + before.size());
  command.replace(command.find("YOUR.key"), std::string::npos, "mine.key");
  EXPECT_EQ(command, "freeze old.policy -o old.policy --force --key mine.key");
  ASSERT_EQ(run(command), 0) << content(folder / "err");
  EXPECT_EQ(run("evaluate old.policy --episodes 2" + kOcean), 0) << content(folder / "err");
}

TEST_F(Programs, FreezeAgainKeepsHowActionsAreDrawnUnlessTold) {
  ASSERT_EQ(run("freeze " + kModels + "version_3_belief.policy -o kept.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("argmax"), std::string::npos);
  ASSERT_EQ(run("freeze kept.policy -o told.policy --key a.key --draw sampled"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("sampled"), std::string::npos);
}

TEST_F(Programs, FreezeAgainRefusesASearchAndADamagedPolicy) {
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  const std::string old = kModels + "version_3_simple.policy";
  std::string bytes = content(old);
  std::ofstream(folder / "search.json") << "{}";
  refuses("freeze " + old + " -o a.policy --key a.key --search search.json", {"--search", "says itself"});
  bytes[9'000] = static_cast<char>(bytes[9'000] ^ 1);
  std::ofstream(folder / "damaged.policy", std::ios::binary) << bytes;
  refuses("freeze damaged.policy -o a.policy --key a.key", {"damaged.policy: is damaged: its CRC-32 is wrong"});
  std::ofstream(folder / "short.policy", std::ios::binary) << bytes.substr(0, 9);
  refuses("freeze short.policy -o a.policy --key a.key", {"short.policy: "});
}

}  // namespace
}  // namespace earshot::policy_programs
