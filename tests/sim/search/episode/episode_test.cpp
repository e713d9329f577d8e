#include "sim/search/episode/episode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "sim/search/belief_model.hpp"
#include "sim/search/known_ocean.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::search {
namespace {

constexpr std::size_t kNorth = 0;
constexpr std::size_t kEast = 2;
constexpr std::size_t kSouth = 4;
constexpr std::size_t kWest = 6;
const policy::OceanTables kNoOceans;

/// 30 dB at the source, one less per kilometre: DT = 10 dB is reached 20 km away.
sonar::SnrCurve one_decibel_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

class EpisodeTest : public testing::Test {
 protected:
  sonar::SnrCurve curve = one_decibel_per_kilometer();
  SearchSettings settings;
  policy::ObservationModel model;
  Episode episode;
};

TEST_F(EpisodeTest, MovesOneStepLengthAlongTheActionsDirection) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(5'000, 7'000), settings.source);
  episode.step(world, kEast);
  EXPECT_EQ(episode.position(), at(5'000, 8'000));
  episode.step(world, 5);                                                             // south-west
  EXPECT_NEAR(episode.position().north.value, 5'000 - 1'000 * std::sqrt(0.5), 1e-6);  // core's sine is good to 1e-12
  EXPECT_NEAR(episode.position().east.value, 8'000 - 1'000 * std::sqrt(0.5), 1e-6);
}

TEST_F(EpisodeTest, EndsWhenItComesWithinAStepLengthOfTheSource) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(10'000, 12'500), settings.source);
  EXPECT_EQ(episode.step(world, kWest), 0.0);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kRunning);  // 1500 m away
  EXPECT_EQ(episode.step(world, kWest), 0.0);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);  // 500 m away
  EXPECT_EQ(episode.record().detections, 2U);
}

TEST_F(EpisodeTest, FindsTheSourceFromExactlyOneStepLength) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(10'000, 12'000), settings.source);
  episode.step(world, kWest);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);
}

TEST_F(EpisodeTest, EndsOutsideTheDomainWithThePenaltyOfWhereItCameOut) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(24'500, 10'000), settings.source);
  // Half a kilometre beyond the edge: -100 (1 + 0.5); 15.5 km from the source it is heard.
  EXPECT_EQ(episode.step(world, kNorth), -150.0);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kLeftDomain);
}

TEST_F(EpisodeTest, CountsASourceReachedJustOutsideTheDomainAsFound) {
  settings.source = at(24'900, 10'000);
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(24'600, 11'100), settings.source);
  episode.step(world, 7);  // north-west, to 25 307 m north, 10 393 m east: 566 m away
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);
}

TEST_F(EpisodeTest, ThatIsPutWithinReachOfTheSourceHasToTakeAStepToFindIt) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(10'000, 10'600), settings.source);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kRunning);
  EXPECT_EQ(episode.record().detections, 0U) << "the start is no detection";
  EXPECT_EQ(episode.record().reward, 0.0);
  EXPECT_NEAR(episode.snr().value, 29.4, 1e-5);  // heard all the same; the curve's floats
  episode.step(world, kEast);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kRunning) << "1600 m away";
  episode.step(world, kWest);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);
}

TEST_F(EpisodeTest, IsCutByTheTimeLimitAfterNSteps) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(15'000, 15'000), settings.source);
  for (int i = 0; i < 99; ++i) episode.step(world, i % 2 == 0 ? kNorth : kSouth);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kRunning);
  episode.step(world, kSouth);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kTimeLimit);
  EXPECT_EQ(episode.record().steps, 100U);
}

TEST_F(EpisodeTest, PrefersFoundOverTheTimeLimitOnTheLastStep) {
  settings.max_steps = 1;
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(10'000, 12'000), settings.source);
  episode.step(world, kWest);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);
}

TEST_F(EpisodeTest, AddsUpItsRewards) {
  const World world(settings, curve);
  episode.start_at(world, model, kNoOceans, at(2'000, 20'500), at(24'000, 2'000));  // 28.7 km away: not heard
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += episode.step(world, kEast);
  // 21.5, 22.5, 23.5 km east are inside the border's inner edge, 24.5 km is half-way through it.
  EXPECT_EQ(sum, -4.0 - 50.0);
  EXPECT_EQ(episode.record().reward, sum);
}

TEST_F(EpisodeTest, SeesTheMemoryStateOfItsLastStepsNewestFirst) {
  const World world(settings, curve);
  model.spec = policy::memory_state(2, settings.step_length, settings.detection_threshold).value();
  std::array<float, 6> seen{};
  episode.start_at(world, model, kNoOceans, at(10'000, 15'000), settings.source);
  episode.observe(seen);
  // At the start no displacement; 25 dB is heard: (25 - 10) / 30.
  EXPECT_EQ(seen[0], 0.0F);
  EXPECT_EQ(seen[1], 0.0F);
  EXPECT_FLOAT_EQ(seen[2], 0.5F);
  episode.step(world, kWest);
  episode.step(world, kNorth);
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 0.0F);
  EXPECT_FLOAT_EQ(seen[1], 1.0F);
  EXPECT_FLOAT_EQ(seen[3], -1.0F);
  EXPECT_FLOAT_EQ(seen[5], (26.0F - 10.0F) / 30.0F);  // 4 km away after the step west
}

TEST_F(EpisodeTest, BelievesThatTheSourceIsNearWhereItIsLoud) {
  settings.domain = {at(0, 0), at(10'000, 30'000)};
  settings.start_region = settings.domain;
  const World world(settings, curve);
  model.belief = belief_model(settings);
  const auto told = std::make_unique<policy::OceanTables>();
  make_known_ocean(settings, curve, *told);
  ASSERT_EQ(model.spec.push_back({.feature = policy::Feature::kEffectiveCells}), Status::kOk);
  episode.start_at(world, model, *told, at(5'000, 5'000), at(5'000, 6'500));  // 28.5 dB
  // Cells of 500 m, 20 north by 60 east: that of the source, and one as far from the vehicle as the area reaches.
  EXPECT_GT(episode.belief().probability(model.belief, 10, 13), 0.0F);
  EXPECT_GT(episode.belief().probability(model.belief, 10, 13), 50.0F * episode.belief().probability(model.belief, 10, 59));
}

TEST_F(EpisodeTest, SeesTheSimpleStateRelativeToTheDomainsSouthWestCorner) {
  const NorthEast corner = at(100'000, -50'000);
  settings.domain = {corner, corner + at(25'000, 25'000)};
  settings.start_region = settings.domain;
  const World world(settings, curve);
  model.spec = policy::simple_state(at(25'000, 25'000));
  std::array<float, 2> seen{};
  episode.start_at(world, model, kNoOceans, corner + at(25'000, 12'500), corner + at(1'000, 1'000));
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 0.0F);  // x, east: in the middle
  EXPECT_FLOAT_EQ(seen[1], 1.0F);  // y, north: at the far edge
}

TEST_F(EpisodeTest, NeverStartsWithinReachOfTheSource) {
  settings.start_region = {at(8'500, 8'500), at(11'500, 11'500)};  // a third of it lies within 1 km of the source
  const World world(settings, curve);
  Pcg32 random(7);
  for (int i = 0; i < 1'000; ++i) {
    episode.start(world, model, kNoOceans, random);
    const NorthEast d = episode.position() - settings.source;
    EXPECT_GT(std::hypot(d.north.value, d.east.value), 1'000.0);
  }
}

TEST_F(EpisodeTest, DrawsAChangingSourceAgainThatLeavesNoPlaceToStart) {
  settings.placement = SourcePlacement::kChanging;
  settings.domain = {at(0, 0), at(2'000, 2'000)};
  settings.start_region = {at(950, 950), at(1'050, 1'050)};  // out of reach of a source near a corner only
  const World world(settings, curve);
  Pcg32 random(7);
  for (int i = 0; i < 200; ++i) {
    episode.start(world, model, kNoOceans, random);
    EXPECT_GT(range_between(episode.position(), episode.source()), Meters{1'000.0});
    EXPECT_TRUE(settings.start_region.contains(episode.position()));
  }
}

TEST_F(EpisodeTest, ScalesNorthAndEastByTheirOwnSidesOfAnAreaThatIsNotSquare) {
  const NorthEast corner = at(-3'000, 7'000);
  settings.domain = {corner, corner + at(8'000, 40'000)};
  settings.start_region = settings.domain;
  const World world(settings, curve);
  model.spec = policy::simple_state(at(8'000, 40'000));
  std::array<float, 2> seen{};
  episode.start_at(world, model, kNoOceans, corner + at(6'000, 30'000), corner + at(1'000, 1'000));
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 0.5F);  // x, east: three quarters of the way from -1 to 1
  EXPECT_FLOAT_EQ(seen[1], 0.5F);  // y, north
  episode.step(world, kNorth);
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 0.5F);
  EXPECT_FLOAT_EQ(seen[1], 0.75F);  // 1 of the 4 km on either side of the middle
  episode.step(world, kEast);
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 0.55F);  // 1 of 20 km
  EXPECT_FLOAT_EQ(seen[1], 0.75F);
  episode.step(world, kNorth);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kRunning) << "on the northern edge";
  episode.step(world, kNorth);
  EXPECT_EQ(episode.record().end, EpisodeEnd::kLeftDomain) << "a kilometre beyond it, though far from the eastern one";
}

TEST_F(EpisodeTest, DrawsNorthAndEastBetweenTheirOwnEdges) {
  settings.placement = SourcePlacement::kChanging;
  settings.domain = {at(-3'000, 7'000), at(5'000, 47'000)};
  settings.start_region = {at(-2'000, 8'000), at(4'000, 46'000)};
  const World world(settings, curve);
  Pcg32 random(7);
  constexpr int kEpisodes = 5'000;
  NorthEast least = settings.start_region.north_east;
  NorthEast most = settings.start_region.south_west;
  for (int i = 0; i < kEpisodes; ++i) {
    episode.start(world, model, kNoOceans, random);
    EXPECT_TRUE(settings.start_region.contains(episode.position()));
    EXPECT_TRUE(settings.domain.contains(episode.source()));
    least = {std::min(least.north, episode.position().north), std::min(least.east, episode.position().east)};
    most = {std::max(most.north, episode.position().north), std::max(most.east, episode.position().east)};
  }
  // Of 5000 uniform numbers one lies within a hundredth of either end but for e^-50.
  EXPECT_LT(least.north.value, -2'000.0 + 60.0);
  EXPECT_GT(most.north.value, 4'000.0 - 60.0);
  EXPECT_LT(least.east.value, 8'000.0 + 380.0);
  EXPECT_GT(most.east.value, 46'000.0 - 380.0);
}

TEST_F(EpisodeTest, StartsUniformlyInItsRegionAndPlacesAChangingSourceUniformlyInTheDomain) {
  settings.placement = SourcePlacement::kChanging;
  settings.start_region = {at(1'000, 1'000), at(24'000, 24'000)};
  const World world(settings, curve);
  Pcg32 random(7);
  constexpr int kEpisodes = 20'000;
  double start_north = 0.0;
  double source_east = 0.0;
  for (int i = 0; i < kEpisodes; ++i) {
    episode.start(world, model, kNoOceans, random);
    EXPECT_TRUE(settings.start_region.contains(episode.position()));
    EXPECT_TRUE(settings.domain.contains(episode.source()));
    start_north += episode.position().north.value / kEpisodes;
    source_east += episode.source().east.value / kEpisodes;
  }
  // Means of uniforms: standard error 25 km / sqrt(12 * 20000) = 51 m; five of them.
  EXPECT_NEAR(start_north, 12'500.0, 255.0);
  EXPECT_NEAR(source_east, 12'500.0, 255.0);
}

TEST_F(EpisodeTest, BeginsAgainWhereItIsWhateverNavigationErredBefore) {
  Conditions conditions;
  conditions.drift_m_per_sqrt_km = 100.0;
  const World world(settings, Soundscape(std::vector{curve}), conditions);
  model.spec = policy::simple_state(at(25'000, 25'000));
  episode.start_at(world, model, kNoOceans, at(5'000, 7'000), settings.source, Pcg32(3));
  episode.step(world, kEast);
  ASSERT_NE(episode.believed_position(), episode.position());
  episode.start_at(world, model, kNoOceans, at(12'500, 25'000), settings.source, Pcg32(3));
  EXPECT_EQ(episode.believed_position(), at(12'500, 25'000));
  std::array<float, 2> seen{};
  episode.observe(seen);
  EXPECT_FLOAT_EQ(seen[0], 1.0F);  // x, east: at the far edge
  EXPECT_FLOAT_EQ(seen[1], 0.0F);  // y, north: in the middle
}

}  // namespace
}  // namespace earshot::search
