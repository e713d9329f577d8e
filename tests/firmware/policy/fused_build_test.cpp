// Built with firmware/policy's sources and every leave to fuse multiplications with additions: a build as no vehicle may fly.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {
namespace {

TEST(FusedBuild, RefusesThePoliciesThatShip) {
  if (__builtin_cpu_supports("fma") == 0) GTEST_SKIP() << "this machine has no fused multiply-add";
  for (const char* name : {"shipped.policy", "fixed_source.policy"}) {
    std::ifstream file(std::string(EARSHOT_SOURCE_DIR "/policy/frozen/") + name, std::ios::binary);
    const std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(file), {});
    auto policy = std::make_unique<FrozenPolicy>();
    PolicyFault fault{};
    EXPECT_EQ(parse(bytes, *policy, fault), Status::kCorrupt) << name;
    EXPECT_EQ(fault, PolicyFault::kGoldenMismatch) << name;
  }
}

}  // namespace
}  // namespace earshot::policy
