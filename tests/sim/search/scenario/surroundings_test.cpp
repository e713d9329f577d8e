// What the conditions of a world make of an episode.
#include "sim/search/scenario/surroundings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "sim/search/episode/episode.hpp"
#include "tests/firmware/place.hpp"
#include "tests/sim/search/scenario/scenario_rig.hpp"

namespace earshot::search {
namespace {

constexpr std::size_t kNorth = 0;
const policy::ObservationModel kSeesNothing;

class Conditions : public testing::Test {
 protected:
  Conditions() { settings.start_region = inside_border(settings); }

  [[nodiscard]] World world() const { return World(settings, soundscape, conditions); }
  /// SNRs heard standing still (no step is taken between measurements) in many searches, 12 km from the source.
  std::vector<double> heard_in_searches(int count) {
    const World w = world();
    Pcg32 random(5);
    std::vector<double> snr_db;
    for (int i = 0; i < count; ++i) {
      episode.start_at(w, kSeesNothing, kNoOceans, at(22'000, 10'000), settings.source, Pcg32(random.next()));
      snr_db.push_back(episode.snr().value);
    }
    return snr_db;
  }

  Soundscape soundscape{std::vector{one_decibel_per_kilometer()}};
  SearchSettings settings;
  search::Conditions conditions;
  Episode episode;
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0.0;
  for (const double x : values) sum += (x - middle) * (x - middle);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

static_assert(std::is_trivially_copyable_v<Surroundings>, "a checkpoint keeps an episode as its bytes");

TEST_F(Conditions, ChangeNothingWhenCalm) {
  const World calm = world();
  EXPECT_TRUE(calm.is_calm());
  const sonar::SnrCurve curve = one_decibel_per_kilometer();
  const World plain(settings, curve);
  Episode other;
  Pcg32 random(3);
  Pcg32 same(3);
  episode.start(calm, kSeesNothing, kNoOceans, random);
  other.start(plain, kSeesNothing, kNoOceans, same);
  EXPECT_EQ(episode.step(calm, kNorth), other.step(plain, kNorth));
  EXPECT_EQ(episode.position(), other.position());
  EXPECT_EQ(episode.reception(), other.reception());
  EXPECT_EQ(random.next(), same.next());
  (void)Surroundings::stream_from(calm, random);
  EXPECT_EQ(random.next(), same.next()) << "a calm world takes no number";
}

TEST_F(Conditions, LeaveStartAndSourceAsInACalmWorldOfTheSameSeed) {
  settings.placement = SourcePlacement::kChanging;
  const World calm = world();
  conditions.fluctuation = Decibels{4.0};
  const World noisy = world();
  Episode other;
  Pcg32 random(3);
  Pcg32 same(3);
  episode.start(calm, kSeesNothing, kNoOceans, random);
  other.start(noisy, kSeesNothing, kNoOceans, same);
  EXPECT_EQ(episode.position(), other.position());
  EXPECT_EQ(episode.source(), other.source());
}

TEST_F(Conditions, FluctuationSpreadsTheSnrNormallyAboutTheModelled) {
  conditions.fluctuation = Decibels{4.0};
  const std::vector<double> snr_db = heard_in_searches(20'000);
  // Five standard errors of mean and standard deviation: 5 * 4 / sqrt(20000) = 0.14, and 0.1.
  EXPECT_NEAR(mean(snr_db), 18.0, 0.14);
  EXPECT_NEAR(standard_deviation(snr_db), 4.0, 0.1);
  const auto within = std::ranges::count_if(snr_db, [](double x) { return std::abs(x - 18.0) < 4.0; });
  EXPECT_NEAR(static_cast<double>(within) / 20'000.0, 0.6827, 0.017);  // of the normal distribution; five standard errors
}

TEST_F(Conditions, FluctuationOfASearchIsUniformBetweenItsBounds) {
  conditions.fluctuation = Decibels{6.0};
  conditions.least_fluctuation = Decibels{2.0};
  constexpr int kSearches = 50'000;
  double second = 0.0;
  double fourth = 0.0;
  for (const double snr : heard_in_searches(kSearches)) {
    const double off = snr - 18.0;
    second += off * off / kSearches;
    fourth += off * off * off * off / kSearches;
  }
  // sigma uniform between a = 2 and b = 6: E x^2 = (b^3 - a^3) / 3 (b - a), E x^4 = 3 (b^5 - a^5) / 5 (b - a), of one sigma 901. Five
  // standard errors, from E x^4 and E x^8 = 105 (b^9 - a^9) / 9 (b - a).
  EXPECT_NEAR(second, 17.333, 0.66);
  EXPECT_NEAR(fourth, 1'161.6, 121.0);
}

TEST_F(Conditions, FluctuationIsDrawnAnewAtEveryMeasurement) {
  conditions.fluctuation = Decibels{4.0};
  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(12'000, 22'000), settings.source);
  std::vector<double> off_db;
  for (int i = 0; i < 40; ++i) {
    episode.step(w, i % 2 == 0 ? kNorth : 4);
    off_db.push_back(episode.snr().value - (30.0 - range_between(episode.position(), episode.source()).value / 1'000.0));
  }
  std::ranges::sort(off_db);
  EXPECT_EQ(std::ranges::adjacent_find(off_db), off_db.end());
}

TEST_F(Conditions, FloorTellsOnlyThatTheSignalIsFainter) {
  conditions.floor = Decibels{15.0};
  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(10'000, 24'000), settings.source);  // 16 dB
  EXPECT_EQ(episode.reception(), (policy::Reception{.snr = Decibels{16.0}, .too_faint = false}));
  episode.start_at(w, kSeesNothing, kNoOceans, at(24'000, 18'000), settings.source);  // 13.9 dB
  EXPECT_EQ(episode.reception(), (policy::Reception{.snr = Decibels{15.0}, .too_faint = true}));
}

TEST_F(Conditions, WhatIsTooFaintToMeasureIsNoDetectionEvenWhenTheFloorLiesAboveTheThreshold) {
  conditions.floor = Decibels{15.0};
  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(20'000, 22'000), settings.source);  // 14.4 dB: above DT, below the floor
  EXPECT_EQ(episode.step(w, kNorth), -1.0);
  EXPECT_EQ(episode.record().detections, 0U);
}

TEST_F(Conditions, LevelIsOffByTheSameInAllOfASearchAndUniformOverSearches) {
  conditions.source_level_spread = Decibels{6.0};
  const std::vector<double> snr_db = heard_in_searches(20'000);
  const auto [least, most] = std::ranges::minmax(snr_db);
  EXPECT_TRUE(least >= 12.0 && least < 12.1) << least;  // 18 - 6; of 20000 uniform numbers one lies within 0.1 but for e^-167
  EXPECT_TRUE(most <= 24.0 && most > 23.9) << most;
  EXPECT_NEAR(standard_deviation(snr_db), 6.0 / std::sqrt(3.0), 0.09);  // of the uniform distribution; five standard errors

  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(12'000, 22'000), settings.source, Pcg32(9));
  const auto off_db = [&] { return episode.snr().value - (30.0 - range_between(episode.position(), episode.source()).value / 1'000.0); };
  const double at_start = off_db();
  episode.step(w, kNorth);
  EXPECT_NEAR(off_db(), at_start, 1e-9);  // sums of doubles near 20
}

TEST_F(Conditions, DriftPartsBeliefFromTruthAsARandomWalk) {
  conditions.drift_m_per_sqrt_km = 50.0;
  const World w = world();
  std::vector<double> north_m;
  for (std::uint64_t i = 0; i < 4'000; ++i) {
    episode.start_at(w, kSeesNothing, kNoOceans, at(20'000, 22'000), settings.source, Pcg32(i));
    EXPECT_EQ(episode.believed_position(), episode.position());
    for (int step = 0; step < 16; ++step) episode.step(w, step % 2 == 0 ? 4 : kNorth);
    EXPECT_EQ(episode.position(), at(20'000, 22'000)) << "the truth does not drift";
    north_m.push_back((episode.believed_position() - episode.position()).north.value);
  }
  EXPECT_NEAR(mean(north_m), 0.0, 16.0);                  // five standard errors: 5 * 200 / sqrt(4000)
  EXPECT_NEAR(standard_deviation(north_m), 200.0, 11.2);  // 50 sqrt(16 km); five standard errors: 5 * 200 / sqrt(8000)
}

TEST_F(Conditions, WhatIsRememberedIsWhereNavigationBelievesTheVehicle) {
  conditions.drift_m_per_sqrt_km = 300.0;
  policy::ObservationModel sees_place;
  sees_place.spec = policy::simple_state(at(25'000, 25'000));
  const World w = world();
  episode.start_at(w, sees_place, kNoOceans, at(12'500, 12'500), settings.source, Pcg32(2));
  for (int i = 0; i < 2; ++i) episode.step(w, kNorth);
  std::array<float, 2> seen{};
  episode.observe(seen);
  EXPECT_NE(episode.believed_position(), episode.position());
  EXPECT_FLOAT_EQ(seen[1], static_cast<float>((episode.believed_position().north.value - 12'500.0) / 12'500.0));
}

TEST_F(Conditions, CurrentCarriesTheVehicleForAsLongAsAStepTakes) {
  conditions.current = Current{.speed = MetersPerSecond{0.2}, .toward = Radians{std::numbers::pi / 2.0}};
  conditions.vehicle_speed = MetersPerSecond{2.0};
  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(15'000, 15'000), settings.source);
  episode.step(w, kNorth);
  EXPECT_NEAR(episode.position().north.value, 16'000.0, 1e-9);  // sine and cosine are good to 4e-16
  EXPECT_NEAR(episode.position().east.value, 15'100.0, 1e-9);   // 0.2 m/s for 500 s
  EXPECT_EQ(episode.believed_position(), episode.position());
}

TEST_F(Conditions, CurrentCarriesAVehicleThatHasGoneFromOnePlaceToAnother) {
  Surroundings surroundings;
  const World calm = world();
  surroundings.start(calm, at(15'000, 15'000), settings.source, Pcg32(1));
  EXPECT_EQ(surroundings.carry(calm, at(15'000, 15'000), at(15'100, 15'200), 120.0), at(15'100, 15'200));
  conditions.current = Current{.speed = MetersPerSecond{0.5}, .toward = Radians{std::numbers::pi}};
  const World w = world();
  surroundings.start(w, at(15'000, 15'000), settings.source, Pcg32(1));
  const NorthEast there = surroundings.carry(w, at(15'000, 15'000), at(15'100, 15'200), 120.0);
  EXPECT_NEAR(there.north.value, 15'040.0, 1e-9);  // 0.5 m/s southwards for 120 s; sine and cosine are good to 4e-16
  EXPECT_NEAR(there.east.value, 15'200.0, 1e-9);
}

TEST_F(Conditions, CurrentThatNavigationDoesNotSeePartsBeliefFromTruth) {
  conditions.current = Current{.speed = MetersPerSecond{0.2}, .toward = Radians{0.0}, .navigation = Current::Navigation::kDoesNotSeeIt};
  const World w = world();
  episode.start_at(w, kSeesNothing, kNoOceans, at(15'000, 15'000), settings.source);
  for (int i = 0; i < 3; ++i) episode.step(w, kNorth);
  EXPECT_NEAR(episode.position().north.value, 18'300.0, 1e-9);
  EXPECT_NEAR(episode.believed_position().north.value, 18'000.0, 1e-9);
}

TEST_F(Conditions, MovingSourceSwimsStraightAtItsSpeedAndStaysInTheDomain) {
  conditions.source_speed = MetersPerSecond{1.0};
  settings.max_steps = 1'000;
  const World w = world();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    episode.start_at(w, kSeesNothing, kNoOceans, at(2'000, 2'000), at(20'000, 20'000), Pcg32(seed));
    NorthEast before = episode.source();
    int straight = 0;
    int steps = 0;
    for (; steps < 100 && episode.record().end == EpisodeEnd::kRunning; ++steps) {
      episode.step(w, steps % 2 == 0 ? kNorth : 4);
      EXPECT_TRUE(settings.domain.contains(episode.source()));
      if (std::abs(range_between(before, episode.source()).value - 500.0) < 1e-6) ++straight;  // 1 m/s for 500 s
      before = episode.source();
    }
    EXPECT_GE(straight, steps * 8 / 10) << "only a step that reflects it is shorter";
  }
}

/// The same loss everywhere.
SnrFan fan_of_80_db(NorthEast centre, double level_db) {
  return {.fan = {.centre = centre,
                  .bearings = 2,
                  .ranges = 40,
                  .range_step = Meters{1'000.0},
                  .depth_m = {300.0},
                  .transmission_loss_db = std::vector<float>(80, 80.0F),
                  .sea_floor_depth_m = {}},
          .source_level = Decibels{level_db},
          .noise_level = Decibels{90.0}};
}

TEST_F(Conditions, MovingSourceIsHeardByTheFieldOfWhereItHasSwum) {
  soundscape = Soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_of_80_db(at(0, 0), 190.0), fan_of_80_db(at(20'000, 0), 200.0)});
  conditions.source_speed = MetersPerSecond{2.0};
  const World w = world();
  Pcg32 random(1);
  int crossings = 0;
  for (int search = 0; search < 20; ++search) {
    bool was_north = false;
    episode.start_at(w, kSeesNothing, kNoOceans, at(12'000, 24'000), at(9'900, 3'000), Pcg32(random.next()));
    for (int i = 0; i < 10 && episode.record().end == EpisodeEnd::kRunning; ++i) {
      episode.step(w, i % 2 == 0 ? kNorth : 4);
      const bool is_north = episode.source().north > Meters{10'000.0};  // nearer to the northern position
      EXPECT_EQ(episode.snr(), Decibels{is_north ? 200.0 - 80.0 - 90.0 : 190.0 - 80.0 - 90.0});
      crossings += is_north != was_north ? 1 : 0;
      was_north = is_north;
    }
  }
  EXPECT_GT(crossings, 5) << "of twenty searches about half swim north";
}

TEST_F(Conditions, OfSeveralSourcesTheLoudestIsHeardAndAnyIsFound) {
  conditions.sources = 3;
  const World w = world();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    episode.start_at(w, kSeesNothing, kNoOceans, at(12'000, 12'000), at(1'000, 24'000), Pcg32(seed));
    EXPECT_LE(range_between(episode.source(), episode.position()), range_between(at(1'000, 24'000), episode.position()));
    EXPECT_NEAR(episode.snr().value, 30.0 - range_between(episode.source(), episode.position()).value / 1'000.0, 1e-9);
    EXPECT_GT(range_between(episode.source(), episode.position()), settings.step_length) << "it would end before its first step";
  }
  // Straight to the nearest, wherever it is, finds it.
  episode.start_at(w, kSeesNothing, kNoOceans, at(12'000, 12'000), at(1'000, 24'000), Pcg32(1));
  ASSERT_NE(episode.source(), at(1'000, 24'000));
  while (episode.record().end == EpisodeEnd::kRunning) {
    std::size_t best = 0;
    for (std::size_t a = 1; a < 8; ++a) {
      const auto range = [&](std::size_t x) {
        return range_between(episode.position() + settings.step_length * w.actions[x], episode.source());
      };
      if (range(a) < range(best)) best = a;
    }
    episode.step(w, best);
  }
  EXPECT_EQ(episode.record().end, EpisodeEnd::kFound);
}

TEST_F(Conditions, CallsGoOnWhileTheVehicleSteps) {
  conditions.floor = Decibels{-50.0};
  conditions.calls = CallPattern{.interval_s = 10.0, .song_s = 500.0, .pause_s = 500.0, .listening_s = 5.0};
  const World w = world();  // a step takes 500 s: a measurement in the song is followed by one in the pause
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    episode.start_at(w, kSeesNothing, kNoOceans, at(22'000, 22'000), settings.source, Pcg32(seed));
    bool was_heard = !episode.reception().too_faint;
    for (int i = 0; i < 6; ++i) {
      episode.step(w, i % 2 == 0 ? 4 : kNorth);
      EXPECT_FALSE(was_heard && !episode.reception().too_faint);
      was_heard = !episode.reception().too_faint;
    }
  }
}

TEST_F(Conditions, ArrivalsTellOfEverySourceAndMakeTheReceptionThatListeningGives) {
  conditions.fluctuation = Decibels{4.0};
  conditions.floor = Decibels{5.0};
  conditions.sources = 3;
  conditions.source_speed = MetersPerSecond{1.0};
  conditions.calls = CallPattern{.interval_s = 15.0, .song_s = 600.0, .pause_s = 300.0, .listening_s = 5.0};
  const World w = world();
  int faint = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Surroundings by_one;
    by_one.start(w, at(22'000, 10'000), settings.source, Pcg32(seed));
    Surroundings by_all = by_one;
    for (int measurement = 0; measurement < 20; ++measurement) {
      const policy::Reception reception = by_one.listen(w, at(22'000, 10'000));
      const Arrivals arrivals = by_all.arrivals(w, at(22'000, 10'000));
      ASSERT_EQ(arrivals.size(), 3U);
      EXPECT_EQ(by_all.reception_of(w, arrivals).snr, reception.snr);
      EXPECT_EQ(by_all.reception_of(w, arrivals).too_faint, reception.too_faint);
      faint += reception.too_faint ? 1 : 0;
      (void)by_one.pass(w, {}, 7.0);
      (void)by_all.pass(w, {}, 7.0);
    }
  }
  EXPECT_GT(faint, 100);  // both are met: of some 1000 measurements
  EXPECT_LT(faint, 900);
}

TEST_F(Conditions, ArrivalOfACalmWorldsSourceIsItsRangeAndItsModelledSnr) {
  const World w = world();
  Surroundings surroundings;
  surroundings.start(w, at(22'000, 10'000), settings.source, Pcg32(1));
  const Arrivals arrivals = surroundings.arrivals(w, at(22'000, 10'000));
  ASSERT_EQ(arrivals.size(), 1U);
  EXPECT_EQ(arrivals[0].range, Meters{12'000.0});
  EXPECT_EQ(arrivals[0].snr, Decibels{18.0});
  EXPECT_EQ(surroundings.reception_of(w, arrivals).snr, Decibels{18.0});
}

TEST_F(Conditions, EverySearchIsInOneOfTheOceans) {
  soundscape = Soundscape({sonar::SnrCurve(Meters{1'000.0}, {20.0F}), sonar::SnrCurve(Meters{1'000.0}, {10.0F})});
  const std::vector<double> snr_db = heard_in_searches(2'000);
  const auto loud = std::ranges::count(snr_db, 20.0);
  EXPECT_EQ(std::ranges::count(snr_db, 10.0), 2'000 - loud);
  EXPECT_NEAR(static_cast<double>(loud), 1'000.0, 112.0);  // five standard errors of a fair coin
}

}  // namespace
}  // namespace earshot::search
