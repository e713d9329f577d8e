#include "policy/freeze/thaw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/freeze.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Of a policy that ships.
Bytes shipped(const std::string& name) {
  std::ifstream stream(EARSHOT_SOURCE_DIR "/policy/frozen/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string refusal_of(const Bytes& bytes) {
  try {
    (void)thaw(bytes, "old.policy");
    return "";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}

TEST(Thaw, KeepsEveryBitOfWhatPoliciesThatShipHold) {
  for (const char* name : {"shipped.policy", "fixed_source.policy"}) {
    const auto policy = thaw(shipped(name), "old.policy");
    const auto read = host::policy_from(shipped(name), "old.policy");
    EXPECT_TRUE(std::ranges::equal(policy->observation.spec, read->observation.spec));
    EXPECT_TRUE(std::ranges::equal(policy->provenance, read->provenance));
    EXPECT_EQ(policy->observation.listening, read->observation.listening);
    EXPECT_EQ(policy->draw, read->draw);
    EXPECT_EQ(policy->network.numbers, read->network.numbers);
  }
}

TEST(Thaw, GivesWhatIsFrozenAgainIntoBytesThatFly) {
  const host::SecretKey key = host::make_key();
  for (const char* name : {"shipped.policy", "fixed_source.policy"}) {
    const Bytes bytes = sign(*thaw(shipped(name), "old.policy"), key);
    EXPECT_NO_THROW((void)host::policy_from(bytes, name));
    EXPECT_EQ(signer_of(bytes), host::public_key_of(key));
    EXPECT_EQ(sign(*thaw(bytes, "new.policy"), key), bytes) << "frozen again without need, it is the same";
  }
}

TEST(Thaw, FliesTheGoldenSearchesAnewWhereAnotherBuildsArithmeticMadeThem) {
  const host::SecretKey key = host::make_key();
  auto policy = thaw(shipped("shipped.policy"), "old.policy");
  const Bytes right = sign(*policy, key);
  policy->golden[0][3].logits[1] += 1.0F;
  EXPECT_EQ(sign(*thaw(sign(*policy, key), "new.policy"), key), right);
}

TEST(Thaw, RefusesAnotherVersionOfTheFormat) {
  Bytes bytes = shipped("shipped.policy");
  bytes[8] = 3;
  EXPECT_TRUE(support::tells(refusal_of(bytes), {"old.policy", "version 3", ".policy"})) << refusal_of(bytes);
}

TEST(Thaw, KnowsAPolicyByItsFirstBytes) {
  EXPECT_TRUE(is_policy("EARSHOTP and more"));
  EXPECT_FALSE(is_policy("EARSHOT"));
  EXPECT_FALSE(is_policy("{\"format\": \"EARSHOTP\"}"));
}

TEST(Thaw, RefusesWhatIsDamagedCutOrSignedByNobody) {
  const Bytes whole = shipped("fixed_source.policy");
  Bytes damaged = whole;
  damaged[5'000] ^= 1U;
  EXPECT_TRUE(support::tells(refusal_of(damaged), {"old.policy", "damaged", "CRC-32", "wrong"}));
  Bytes unsigned_ = whole;
  unsigned_.back() ^= 1U;
  EXPECT_TRUE(support::tells(refusal_of(unsigned_), {"old.policy", "signature", "not", "carries"}));
  for (std::size_t size = 8; size < whole.size(); size += 101)
    EXPECT_EQ(refusal_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}).rfind("old.policy: ", 0), 0U) << size;
}

}  // namespace
}  // namespace earshot::freeze
