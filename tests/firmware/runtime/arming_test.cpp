// Built several times, each with other arithmetic (CMakeLists.txt): only the one that the core is built with arms the policies that ship.
// Another tanh is noticed by those that have a network.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "firmware/policy/format/policy_format.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/support/mission_for.hpp"
#include "tests/support/three_oceans.hpp"

#ifndef EARSHOT_STATUS_WITHOUT_NETWORK
#define EARSHOT_STATUS_WITHOUT_NETWORK EARSHOT_STATUS
#endif

namespace earshot::runtime {
namespace {

Status armed_with(const std::string& name) {
  std::ifstream stream(EARSHOT_SOURCE_DIR "/policy/frozen/" + name, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  EXPECT_EQ(policy::parse(bytes, *policy, complaint), Status::kOk) << name;
  const config::Mission mission = support::mission_for(*policy);
  return std::make_unique<Runtime>()->configure(mission, *policy,
                                                *support::three_oceans(policy->area_size, mission.search_depth, mission.source_frequency));
}

class EARSHOT_ARITHMETIC : public testing::Test {
 protected:
  void SetUp() override {
#if defined(EARSHOT_FUSES) && !defined(__FMA__) && !defined(__ARM_FEATURE_FMA)
    GTEST_SKIP() << "this machine, or this build for it, has no fused multiply-add";
#endif
  }
};

TEST_F(EARSHOT_ARITHMETIC, EARSHOT_WHAT_IT_DOES) {
  EXPECT_EQ(armed_with("shipped.policy"), EARSHOT_STATUS_WITHOUT_NETWORK);
  EXPECT_EQ(armed_with("fixed_source.policy"), EARSHOT_STATUS);
}

}  // namespace
}  // namespace earshot::runtime
