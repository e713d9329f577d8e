// A policy that is frozen again.
#include "tests/policy/apps/programs.hpp"

namespace earshot::policy_programs {
namespace {

const std::string kShipped = kSource + "/policy/frozen/shipped.policy";

TEST_F(Programs, FreezeAgainKeepsHowActionsAreDrawnUnlessTold) {
  ASSERT_EQ(run("freeze " + kShipped + " -o kept.policy --key a.key --new-key"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("argmax"), std::string::npos);
  ASSERT_EQ(run("freeze kept.policy -o told.policy --key a.key --draw sampled"), 0) << content(folder / "err");
  EXPECT_NE(content(folder / "out").find("sampled"), std::string::npos);
}

TEST_F(Programs, FreezeAgainRefusesASearchAndADamagedPolicy) {
  ASSERT_EQ(run("freeze --key a.key --new-key"), 0);
  const std::string old = kFixedSource;
  std::string bytes = content(old);
  std::ofstream(folder / "search.json") << "{}";
  refuses("freeze " + old + " -o a.policy --key a.key --search search.json", {"--search", "states itself"});
  bytes[9'000] = static_cast<char>(bytes[9'000] ^ 1);
  std::ofstream(folder / "damaged.policy", std::ios::binary) << bytes;
  refuses("freeze damaged.policy -o a.policy --key a.key", {"damaged.policy: is damaged: its CRC-32 is wrong"});
  std::ofstream(folder / "short.policy", std::ios::binary) << bytes.substr(0, 9);
  refuses("freeze short.policy -o a.policy --key a.key", {"short.policy: "});
}

}  // namespace
}  // namespace earshot::policy_programs
