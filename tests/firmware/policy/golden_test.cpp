#include "firmware/policy/golden.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "firmware/core/math.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "tests/firmware/emulated.hpp"
#include "tests/firmware/policy/made_up_policy.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"

namespace earshot::policy {
namespace {

/// believing_policy() with a belief in few cells, for what is asked of it many times.
const FrozenPolicy& coarse_policy() {
  static const std::unique_ptr<const FrozenPolicy> kept = [] {
    auto policy = believing_policy();
    policy->observation.belief.cells_north = 11;
    policy->observation.belief.cells_east = 13;
    record(*policy);
    return policy;
  }();
  return *kept;
}

bool repeats_after(const std::function<void(FrozenPolicy&)>& damage, const FrozenPolicy& good = coarse_policy()) {
  const auto policy = std::make_unique<FrozenPolicy>(good);
  damage(*policy);
  return repeats(*policy);
}

void flip(float& value) {
  value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1U);
}

TEST(Golden, IsRepeatedByTheBuildThatRecordedIt) {
  EXPECT_TRUE(repeats(*small_policy()));
  EXPECT_TRUE(repeats(*believing_policy()));
}

TEST(Golden, HoldsWhatASearchAlongItsPlacesSeesAndDecides) {
  const auto policy = believing_policy();
  const auto memory = std::make_unique<SearchMemory>();
  const auto tables = std::make_unique<OceanTables>();
  make_golden_tables(policy->area_size, *tables);
  const GoldenTrajectory& trajectory = policy->golden[1];
  memory->start(policy->observation, *tables, trajectory[0].place, trajectory[0].reception.heard());
  memory->remember(policy->observation, *tables, trajectory[1].place, trajectory[1].reception.heard());
  std::array<float, 2> observation{};
  observe(*memory, policy->observation, observation);
  std::array<float, 4> logits{};
  forward(policy->network, observation, logits);
  const GoldenStep& step = trajectory[1];
  EXPECT_EQ(step.belief.mean, memory->belief().summary().mean);
  EXPECT_EQ(step.fingerprint, memory->belief().fingerprint(policy->observation.belief));
  EXPECT_TRUE(std::equal(observation.begin(), observation.end(), step.observation.begin()));
  EXPECT_TRUE(std::equal(logits.begin(), logits.end(), step.logits.begin()));
}

TEST(Golden, HoldsTheBeliefsOwnAdviceOfAPolicyWithoutANetwork) {
  const auto policy = advising_policy();
  ASSERT_TRUE(repeats(*policy));
  for (const GoldenStep& step : policy->golden[0]) {
    // Its observation: spread, then the preferences of actions 3, 2, 1 and 0.
    for (std::size_t action = 0; action < 4; ++action) EXPECT_EQ(step.logits[action], step.observation[4 - action]) << action;
    EXPECT_EQ(*std::max_element(step.logits.begin(), step.logits.end()), 1.0F) << "no regret";
  }
  EXPECT_FALSE(repeats_after([](FrozenPolicy& damaged) { flip(damaged.golden[1][2].logits[3]); }, *policy));
}

/// What stands in the vehicle's memory for tables is the mission's, or garbage.
TEST(Golden, IsRepeatedWhateverTheTablesHeld) {
  const auto policy = believing_policy();
  const auto memory = std::make_unique<SearchMemory>();
  const auto tables = std::make_unique<OceanTables>(made_up_tables());
  EXPECT_TRUE(repeats_golden(*policy, *memory, *tables));
  EXPECT_TRUE(repeats_golden(*policy, *memory, *tables)) << "its own oceans";
}

/// 128 ranges across an area of 25.4 km x 12.7 km stand every 300 m. By hand: half a decibel is one; the source is heard at 50 dB.
TEST(GoldenTables, AreTwoStraightLinesAndOneWithZones) {
  const auto tables = std::make_unique<OceanTables>(made_up_tables());
  make_golden_tables({.north = Meters{25'400}, .east = Meters{12'700}}, *tables);
  EXPECT_TRUE(has_valid_shape(*tables));
  EXPECT_EQ(tables->range_count, 128);
  EXPECT_EQ(tables->range_step, Meters{300});
  ASSERT_EQ(tables->tables.size(), 3U);
  struct Expected {
    std::size_t range;
    std::array<int, 3> half_db;
  };
  // The first loses 1 dB a range and ends at -50 dB; the second half as much. The third loses 0.25 dB a range in zones of six ranges that
  // begin every 40, and 1.5 dB a range between them.
  for (const auto& [range, half_db] :
       {Expected{0, {100, 100, 100}}, Expected{1, {98, 99, 100}}, Expected{5, {90, 95, 98}}, Expected{6, {88, 94, 82}},
        Expected{39, {22, 61, -17}}, Expected{40, {20, 60, 80}}, Expected{45, {10, 55, 78}}, Expected{46, {8, 54, -38}},
        Expected{100, {-100, 0, -100}}, Expected{101, {-100, -1, -100}}, Expected{125, {-100, -25, 38}}, Expected{127, {-100, -27, -100}}})
    for (std::size_t table = 0; table < 3; ++table)
      EXPECT_EQ(tables->tables[table].snr_half_db[range], half_db[table]) << "table " << table << " range " << range;
  for (const OceanTable& table : tables->tables) EXPECT_EQ(table.prior, 1.0F);
}

TEST(Golden, KnowsNoBeliefWhereThePolicySeesNone) {
  EXPECT_EQ(small_policy()->golden[0][3].fingerprint, 0U);
  EXPECT_EQ(small_policy()->golden[0][3].belief.spread, Meters{});
}

/// The policies that ship were frozen on one machine; every other must come to the same bits.
TEST(Golden, OfThePoliciesThatShipIsRepeatedOnThisMachine) {
  for (const char* name : {"shipped.policy", "fixed_source.policy"}) {
    std::ifstream stream(std::string(EARSHOT_SOURCE_DIR "/policy/frozen/") + name, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const auto policy = std::make_unique<FrozenPolicy>();
    PolicyComplaint complaint;
    ASSERT_EQ(parse(bytes, *policy, complaint), Status::kOk) << name;
    EXPECT_TRUE(repeats(*policy)) << name;
  }
}

TEST(Golden, IsNotRepeatedWhenABitOfAnyStepDiffers) {
  for (std::size_t i = 0; i < config::kGoldenSteps; i += tests::times(1, 5)) {
    EXPECT_FALSE(repeats_after([i](FrozenPolicy& policy) { flip(policy.golden[1][i].logits[3]); })) << i;
    EXPECT_FALSE(repeats_after([i](FrozenPolicy& policy) { flip(policy.golden[0][i].observation[1]); })) << i;
    EXPECT_FALSE(repeats_after([i](FrozenPolicy& policy) { policy.golden[0][i].fingerprint ^= 1U; })) << i;
    EXPECT_FALSE(repeats_after([i](FrozenPolicy& policy) { flip(policy.golden[1][i].belief.effective_cells); })) << i;
    EXPECT_FALSE(repeats_after([i](FrozenPolicy& policy) { policy.golden[1][i].belief.mean.east += Meters{1e-9}; })) << i;
  }
}

TEST(Golden, IsNotRepeatedByOtherWeightsCostsOrSounds) {
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.network.layer(0).weight(0, 0) += 1e-3F; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.observation.belief.costs.edge = 1.0F; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.observation.belief.costs.most_regret = 8.0F; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][0].reception.too_faint = true; }));
}

TEST(Golden, IsNotRepeatedWhenALogitIsNoNumber) {
  // What check() would refuse, and what no vehicle should trust though its bits be the same.
  const auto policy = small_policy();
  std::ranges::fill(policy->network.layer(2).packed, 3e38F);
  std::ranges::fill(policy->network.layer(1).bias, 9.0F);
  record(*policy);
  EXPECT_FALSE(repeats(*policy));
}

TEST(Golden, IsNotRepeatedWhenTheLastLogitAloneIsNan) {
  const auto policy = small_policy();
  policy->network.layer(2).bias[3] = std::numeric_limits<float>::quiet_NaN();
  record(*policy);
  EXPECT_TRUE(is_finite(policy->golden[1][5].logits[2]));
  EXPECT_TRUE(std::isnan(policy->golden[1][5].logits[3]));
  EXPECT_FALSE(repeats(*policy));
}

TEST(Golden, IsNotRepeatedWhereElementsThatThePolicyHasNotAreNotZero) {
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][2].logits[4] = 1.0F; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][2].observation.back() = 1.0F; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[1][0].fingerprint = 1; }, *small_policy()));
}

TEST(Golden, IsNotRepeatedByABeliefThatDiffersInAnyOfItsNumbers) {
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][4].belief.likeliest.north += Meters{1e-9}; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][4].belief.likeliest.east += Meters{1e-9}; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][4].belief.mean.north += Meters{1e-9}; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { policy.golden[0][4].belief.spread += Meters{1e-9}; }));
  EXPECT_FALSE(repeats_after([](FrozenPolicy& policy) { flip(policy.golden[0][4].belief.likeliest_share); }));
}

TEST(Fingerprint, SeesEveryCellAndActionValue) {
  const auto policy = believing_policy();
  const BeliefModel& model = policy->observation.belief;
  const auto tables = std::make_unique<OceanTables>();
  make_golden_tables(model.area_size, *tables);
  const auto belief = std::make_unique<OceanBelief>();
  belief->start(model, *tables);
  belief->update(model, *tables, {Meters{5000}, Meters{5000}}, {.snr = Decibels{1}});
  const std::uint32_t before = belief->fingerprint(model);
  belief->update(model, *tables, {Meters{5000}, Meters{5000}}, {.snr = Decibels{1}});
  EXPECT_NE(belief->fingerprint(model), before);
}

}  // namespace
}  // namespace earshot::policy
