#include "policy/freeze/thaw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/freeze/freeze.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::freeze {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const std::string& name) {
  std::ifstream stream(EARSHOT_SOURCE_DIR "/tests/policy/freeze/models/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

float float_at(const Bytes& bytes, std::size_t at) {
  std::array<std::uint8_t, 4> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), raw.size(), raw.begin());
  return std::bit_cast<float>(raw);
}

std::string refusal_of(const Bytes& bytes) {
  try {
    (void)thaw(bytes, "old.policy");
    return "";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}

TEST(Thaw, KeepsWhatVersion3SaysOfThePaperFixedSource) {
  const auto policy = thaw(bytes_of("version_3_simple.policy"), "old.policy");
  EXPECT_EQ(policy->observation.spec.size(), 2U);
  EXPECT_EQ(policy->observation.spec[1].feature, policy::Feature::kNorth);
  EXPECT_EQ(policy->observation.spec[1].offset, 12'500.0F);
  EXPECT_EQ(policy->actions.size(), 8U);
  EXPECT_EQ(policy->actions[2], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(policy->step_length, Meters{1'000.0});
  EXPECT_EQ(policy->area_size, (NorthEast{Meters{25'000.0}, Meters{25'000.0}}));
  EXPECT_EQ(policy->detection_threshold, Decibels{10.0});
  EXPECT_EQ(policy->draw, policy::ActionDraw::kSampled);
  const std::string provenance(policy->provenance.begin(), policy->provenance.end());
  EXPECT_TRUE(provenance.starts_with("command = earshot-train policy/ppo/runs/fixed_source.toml"));
  EXPECT_TRUE(provenance.ends_with("reward_scale = 1\n"));
}

TEST(Thaw, KeepsEveryWeightOfVersion3) {
  // The format of version 3: 64 bytes of header, 12 of each element, 16 of each direction, then the weights [64 x 2], biases [64] and so
  // on.
  const Bytes bytes = bytes_of("version_3_simple.policy");
  const auto policy = thaw(bytes, "old.policy");
  std::size_t at = 64 + 2 * 12 + 8 * 16;
  const auto expect_layer = [&](const auto& layer, std::size_t outputs, std::size_t inputs) {
    for (std::size_t i = 0; i < outputs * inputs; ++i, at += 4) ASSERT_EQ(layer.weight(i / inputs, i % inputs), float_at(bytes, at)) << i;
    for (std::size_t i = 0; i < outputs; ++i, at += 4) ASSERT_EQ(layer.bias[i], float_at(bytes, at)) << i;
  };
  expect_layer(policy->network.first, 64, 2);
  expect_layer(policy->network.second, 64, 64);
  expect_layer(policy->network.output, 8, 64);
}

TEST(Thaw, KeepsTheBeliefOfVersion3AndGivesItTheCostsItFlewWith) {
  const Bytes bytes = bytes_of("version_3_belief.policy");
  const auto policy = thaw(bytes, "old.policy");
  const policy::BeliefModel& belief = policy->observation.belief;
  EXPECT_EQ(belief.cells_north * belief.cells_east, 2500);
  EXPECT_EQ(belief.hypotheses.size(), 4U);
  EXPECT_EQ(belief.hypotheses[2].level_offset_db, -6.0F);
  EXPECT_EQ(belief.range_step, Meters{100.0});
  const std::size_t ranges_at = 64 + 62 * 12 + 8 * 16 + 36 + 4 * 12;
  for (std::size_t i = 0; i < belief.snr_db.size(); ++i) ASSERT_EQ(belief.snr_db[i], float_at(bytes, ranges_at + 4 * i)) << i;
  EXPECT_EQ(belief.costs, (policy::BeliefCosts{.step = 3.0F,
                                               .log_step_discount = -0.105360516F,
                                               .reach = 30.0F,
                                               .reach_discount = 0.85F,
                                               .edge = 100.0F,
                                               .most_regret = 10.0F}));
}

TEST(Thaw, GivesWhatIsFrozenAgainIntoBytesThatFly) {
  const host::SecretKey key = host::make_key();
  for (const char* name : {"version_3_simple.policy", "version_3_belief.policy"}) {
    const Bytes bytes = sign(*thaw(bytes_of(name), "old.policy"), key);
    EXPECT_NO_THROW((void)host::policy_from(bytes, name));
    EXPECT_EQ(signer_of(bytes), host::public_key_of(key));
    EXPECT_EQ(sign(*thaw(bytes, "new.policy"), key), bytes) << "frozen again without need, it is the same";
  }
}

TEST(Thaw, FliesTheGoldenSearchesAnewWhereAnotherBuildsArithmeticMadeThem) {
  const host::SecretKey key = host::make_key();
  auto policy = thaw(bytes_of("version_3_belief.policy"), "old.policy");
  const Bytes right = sign(*policy, key);
  policy->golden[0][3].logits[1] += 1.0F;
  EXPECT_EQ(sign(*thaw(sign(*policy, key), "new.policy"), key), right);
}

void put_number(Bytes& bytes, std::size_t at, std::uint64_t number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.at(at + i) = static_cast<std::uint8_t>(number >> (8 * i));
}

/// With length, key, checksum and signature to match: 32, 4 and 64 bytes at the end.
Bytes sealed(Bytes bytes) {
  const std::size_t size = bytes.size();
  put_number(bytes, 12, size, 4);
  std::ranges::copy(support::public_key(), bytes.end() - 100);
  put_number(bytes, size - 68, crc32(std::span(bytes).first(size - 68)), 4);
  support::sign(bytes);
  return bytes;
}

TEST(Thaw, RefusesSizesOfVersion3ThatNoVehicleHolds) {
  const Bytes whole = bytes_of("version_3_belief.policy");
  EXPECT_EQ(refusal_of(sealed(whole)), "");
  const auto with = [&](std::size_t at, std::uint64_t number, std::size_t size) {
    Bytes bytes = whole;
    put_number(bytes, at, number, size);
    return refusal_of(sealed(bytes));
  };
  const std::string too_many = "old.policy: has a size that is zero or more than a vehicle can hold";
  EXPECT_EQ(with(16, 2, 1), "old.policy: has another activation than tanh");
  EXPECT_EQ(with(18, 0, 1), too_many) << "observations";
  EXPECT_EQ(with(18, config::kMaxObservation + 1, 1), too_many);
  EXPECT_EQ(with(19, 0, 1), too_many) << "actions";
  EXPECT_EQ(with(19, config::kMaxActions + 1, 1), too_many);
  EXPECT_EQ(with(20, 0, 2), too_many) << "units";
  EXPECT_EQ(with(22, 65, 2), too_many);
  EXPECT_EQ(with(56, config::kMaxProvenance + 1, 4), too_many);
  EXPECT_EQ(with(60, config::kMaxBeliefHypotheses + 1, 2), too_many);
  EXPECT_EQ(with(62, config::kMaxBeliefRanges + 1, 2), too_many);
  for (const std::size_t at : {18U, 19U, 20U, 22U, 60U, 62U})
    EXPECT_EQ(with(at, whole[at] - 1U, 1), "old.policy: is not as long as what it holds") << at;
}

TEST(Thaw, RefusesBytesShorterThanWhatEveryPolicyEndsWith) {
  Bytes bytes = bytes_of("version_3_simple.policy");
  bytes.resize(99);
  put_number(bytes, 12, 99, 4);
  EXPECT_EQ(refusal_of(bytes), "old.policy: is not as long as it says");
  Bytes longer = bytes_of("version_3_simple.policy");
  longer.push_back(0);
  EXPECT_EQ(refusal_of(longer), "old.policy: is not as long as it says");
  EXPECT_EQ(refusal_of(sealed(longer)), "old.policy: is not as long as what it holds");
}

TEST(Thaw, KeepsABeliefOfOneHypothesis) {
  // The simple policy with a belief that it does not show: as much as there can be least.
  const Bytes belief = bytes_of("version_3_belief.policy");
  constexpr std::ptrdiff_t kBelief = 64 + 62 * 12 + 8 * 16;
  Bytes bytes = bytes_of("version_3_simple.policy");
  bytes.insert(bytes.begin() + 64 + 2 * 12 + 8 * 16, belief.begin() + kBelief, belief.begin() + kBelief + 36 + 12);
  put_number(bytes, 60, 1, 2);
  const auto policy = thaw(sealed(bytes), "old.policy");
  ASSERT_EQ(policy->observation.belief.hypotheses.size(), 1U);
  EXPECT_EQ(policy->observation.belief.hypotheses[0].prior, 2.0F);
  EXPECT_EQ(policy->observation.belief.range_step, Meters{100.0});
  EXPECT_EQ(policy->network.first.weight(0, 0), float_at(bytes, 64 + 2 * 12 + 8 * 16 + 36 + 12));
}

TEST(Thaw, KnowsAPolicyByItsFirstBytes) {
  EXPECT_TRUE(is_policy("EARSHOTP and more"));
  EXPECT_FALSE(is_policy("EARSHOT"));
  EXPECT_FALSE(is_policy("{\"format\": \"EARSHOTP\"}"));
}

TEST(Thaw, RefusesWhatIsDamagedCutOrSignedByNobody) {
  const Bytes whole = bytes_of("version_3_belief.policy");
  Bytes damaged = whole;
  damaged[5'000] ^= 1U;
  EXPECT_EQ(refusal_of(damaged), "old.policy: is damaged: its CRC-32 is wrong");
  Bytes unsigned_ = whole;
  unsigned_.back() ^= 1U;
  EXPECT_EQ(refusal_of(unsigned_), "old.policy: its signature is not that of the key it carries");
  for (std::size_t size = 8; size < whole.size(); size += 101)
    EXPECT_EQ(refusal_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}).rfind("old.policy: ", 0), 0U) << size;
}

}  // namespace
}  // namespace earshot::freeze
