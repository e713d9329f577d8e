// What an episode hears of the measurements on its steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/search/episode/episode.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::search {
namespace {

using config::Listening;

constexpr std::size_t kNorth = 0;
constexpr std::size_t kEast = 2;
const policy::ObservationModel kSeesNothing;
const policy::OceanTables kNoOceans;

/// 30 dB at the source, one less per kilometre.
sonar::SnrCurve one_decibel_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

class ListeningEpisode : public testing::Test {
 protected:
  void listen(Listening listening, std::int64_t seconds) {
    settings.listening = {.listening = listening, .length = Duration::seconds(seconds)};
  }
  [[nodiscard]] World world() const { return World(settings, soundscape, conditions); }

  Soundscape soundscape{std::vector{one_decibel_per_kilometer()}};
  SearchSettings settings;
  Conditions conditions;
  Episode episode;
};

TEST_F(ListeningEpisode, HearsTheLoudestMeasurementOnItsWayWhereItWasTaken) {
  // A step of 500 s ends 7 km north of the source, and comes from 6 km. At 2 m/s the first of 60 measurements was 118 m nearer.
  // Of two measurements it was 2 m nearer.
  for (const auto& [listening, measurements, nearer_m] :
       {std::tuple{Listening::kLoudest, 60, 118.0}, std::tuple{Listening::kMean, 60, 59.0}, std::tuple{Listening::kLoudest, 2, 2.0},
        std::tuple{Listening::kMean, 2, 1.0}}) {
    listen(listening, measurements);
    const World calm = world();
    episode.start_at(calm, kSeesNothing, kNoOceans, at(16'000, 10'000), settings.source);
    EXPECT_NEAR(episode.snr().value, 24.0, 1e-6) << "the start has one look";
    episode.step(calm, kNorth);
    EXPECT_NEAR(episode.snr().value, 23.0 + nearer_m / 1'000.0, 1e-5);  // the curve's floats
    EXPECT_NEAR(episode.position().north.value, 17'000.0, 1e-8);        // 60 sums
  }
}

TEST_F(ListeningEpisode, CountsADetectionAnywhereInItsWindow) {
  // DT = 10 dB is 20 km away, which the vehicle passes 100 m, or 50 s, before the step's end.
  for (const auto& [seconds, detections] : {std::pair{40, 0U}, std::pair{60, 1U}}) {
    listen(Listening::kLoudest, seconds);
    const World calm = world();
    settings.source = at(1'000, 1'000);
    episode.start_at(calm, kSeesNothing, kNoOceans, at(1'000, 20'100), at(1'000, 1'000));
    EXPECT_EQ(episode.step(calm, kEast), detections == 1 ? 0.0 : -1.0);
    EXPECT_EQ(episode.record().detections, detections);
  }
}

TEST_F(ListeningEpisode, NeverReachesBackBeyondItsStep) {
  settings.step_length = Meters{100.0};  // 50 s
  listen(Listening::kLoudest, 120);
  const World calm = world();
  episode.start_at(calm, kSeesNothing, kNoOceans, at(16'000, 10'000), settings.source);
  episode.step(calm, kNorth);
  episode.step(calm, kNorth);
  EXPECT_NEAR(episode.snr().value, 30.0 - 6.102, 1e-5);  // the second step's first measurement, 2 m from where it began
}

TEST_F(ListeningEpisode, MovesDriftsAndSwimsAsFarAsWithoutAWindow) {
  conditions.current = Current{.speed = MetersPerSecond{0.2}, .toward = Radians{0.0}};
  conditions.source_speed = MetersPerSecond{0.5};
  const World newest = world();
  listen(Listening::kLoudest, 30);
  const World loudest = world();
  Episode other;
  episode.start_at(newest, kSeesNothing, kNoOceans, at(5'000, 5'000), at(15'000, 15'000), Pcg32(4));
  other.start_at(loudest, kSeesNothing, kNoOceans, at(5'000, 5'000), at(15'000, 15'000), Pcg32(4));
  for (int i = 0; i < 6; ++i) {
    episode.step(newest, i % 2 == 0 ? kNorth : kEast);
    other.step(loudest, i % 2 == 0 ? kNorth : kEast);
    EXPECT_LT(range_between(episode.position(), other.position()).value, 1e-6);  // 180 sums
    EXPECT_LT(range_between(episode.source(), other.source()).value, 1e-6);
  }
}

TEST_F(ListeningEpisode, FluctuatesByTheLargestOrTheMeanOfAsManyDraws) {
  conditions.fluctuation = Decibels{4.0};
  soundscape = Soundscape({sonar::SnrCurve(Meters{1'000.0}, {20.0F})});
  constexpr int kSteps = 4'000;
  for (const auto& [listening, mean_db, spread_db] : {std::tuple{Listening::kMean, 20.0, 4.0 / std::sqrt(10.0)},
                                                      // of the largest of ten normal numbers: Harter, Biometrika 48 (1961) 151, table 1
                                                      // (mean); Tippett, Biometrika 17 (1925) 364 (standard deviation)
                                                      std::tuple{Listening::kLoudest, 20.0 + 4.0 * 1.53875, 4.0 * 0.58681}}) {
    listen(listening, 10);
    const World noisy = world();
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      episode.start_at(noisy, kSeesNothing, kNoOceans, at(20'000, 20'000), settings.source, Pcg32(static_cast<std::uint64_t>(i)));
      episode.step(noisy, kNorth);
      sum += episode.snr().value;
      squares += (episode.snr().value - mean_db) * (episode.snr().value - mean_db);
    }
    EXPECT_NEAR(sum / kSteps, mean_db, 5.0 * spread_db / std::sqrt(kSteps));                   // five standard errors
    EXPECT_NEAR(std::sqrt(squares / kSteps), spread_db, 5.0 * spread_db / std::sqrt(kSteps));  // wider than five for a normal number
  }
}

TEST_F(ListeningEpisode, DrawsNothingMoreWhenItListensToTheNewestAlone) {
  conditions.fluctuation = Decibels{4.0};
  const World newest = world();
  listen(Listening::kLoudest, 1);
  const World one_second = world();
  Episode other;
  episode.start_at(newest, kSeesNothing, kNoOceans, at(5'000, 5'000), settings.source, Pcg32(4));
  other.start_at(one_second, kSeesNothing, kNoOceans, at(5'000, 5'000), settings.source, Pcg32(4));
  for (int i = 0; i < 5; ++i) {
    episode.step(newest, kNorth);
    other.step(one_second, kNorth);
    EXPECT_EQ(episode.reception(), other.reception());
  }
}

}  // namespace
}  // namespace earshot::search
