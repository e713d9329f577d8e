// What a vehicle hears in flight, tick by tick, is what the environment that its policy is trained in says that it hears.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/apps/fly/flight_record.hpp"
#include "sim/search/episode/episode.hpp"
#include "sim/vehicle/vehicle.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::fly {
namespace {

using config::Listening;
using messages::Order;

constexpr int kSearches = 200;
constexpr std::size_t kSteps = 12;  // of 100 s: a song and its pause
constexpr double kFluctuation_db = 2.0;
const policy::OceanTables kNoOceans;  // a policy that sees no belief needs none

/// A whale that sings for 15 minutes, a pulse of one second every 15 s, and pauses for 5; equally loud everywhere.
class ListeningAgreement : public testing::TestWithParam<config::ListeningWindow> {
 protected:
  ListeningAgreement() {
    settings.step_length = Meters{200.0};
    settings.source = at(20'000, 20'000);
    settings.listening = GetParam();
    conditions.fluctuation = Decibels{kFluctuation_db};
    conditions.floor = Decibels{-50.0};
    conditions.calls = search::CallPattern{.interval_s = 15.0, .song_s = 900.0, .pause_s = 300.0, .listening_s = 1.0};
  }

  [[nodiscard]] std::vector<policy::Reception> receptions_in_the_environment() {
    const search::World world(settings, soundscape, conditions);
    const policy::ObservationModel sees_nothing;
    std::vector<policy::Reception> receptions;
    search::Episode episode;
    for (std::uint64_t seed = 0; seed < kSearches; ++seed) {
      episode.start_at(world, sees_nothing, kNoOceans, at(2'000, 2'000), settings.source, Pcg32(seed));
      for (std::size_t i = 0; i < kSteps; ++i) {
        episode.step(world, 0);
        receptions.push_back(episode.reception());
      }
      detections += episode.record().detections;
    }
    return receptions;
  }

  /// The runtime that flies, the simulator's vehicle and its measurements, second by second, as lock_step has them.
  [[nodiscard]] std::vector<policy::Reception> receptions_in_flight() {
    const search::World world(settings, soundscape, conditions);
    const auto policy = runtime::policy_that_goes(runtime::kNorthward);
    policy->step_length = settings.step_length;
    policy->observation.listening = settings.listening;
    config::Mission mission = runtime::paper_mission();
    mission.operating_area = settings.domain;
    mission.step_length = settings.step_length;
    mission.listening = settings.listening;
    std::vector<policy::Reception> receptions;
    for (std::uint64_t seed = 0; seed < kSearches; ++seed) fly(world, *runtime::frozen(*policy), mission, Pcg32(1'000 + seed), receptions);
    return receptions;
  }

  void fly(const search::World& world, const policy::FrozenPolicy& policy, const config::Mission& mission, Pcg32 random,
           std::vector<policy::Reception>& receptions) {
    auto runtime = std::make_unique<runtime::Runtime>();
    ASSERT_EQ(runtime->configure(mission, policy, kNoOceans), Status::kOk);
    vehicle::State vehicle{
        .position = at(2'000, 2'000), .depth = mission.search_depth, .heading = Radians{0.0}, .speed = mission.search_speed};
    search::Surroundings surroundings;
    surroundings.start(world, vehicle.position, settings.source, random);
    Score score(settings);
    std::size_t decisions = 0;
    for (Time now; decisions <= kSteps; now = now + search::kMeasurementInterval) {
      const policy::Reception measurement = surroundings.listen(world, vehicle.position);
      if (now == Time{}) runtime->take({.arrival = now, .port = 0, .sequence = 0, .value = runtime::command_of(Order::kStart, now)});
      runtime->take(
          {.arrival = now,
           .port = 0,
           .sequence = 0,
           .value = messages::Navigation{
               .time = now, .position = vehicle.position, .depth = vehicle.depth, .heading = vehicle.heading, .speed = vehicle.speed}});
      runtime->take({.arrival = now,
                     .port = 0,
                     .sequence = 0,
                     .value = messages::SnrMeasurement{.time = now, .snr = measurement.snr, .too_faint = measurement.too_faint}});
      const runtime::Outputs outputs = runtime->step(now);
      if (outputs.decision && decisions++ > 0)
        receptions.push_back({.snr = outputs.decision->snr, .too_faint = outputs.decision->too_faint});
      score.hear({.time = now, .snr = measurement.snr, .too_faint = measurement.too_faint});
      score.add({.time = now,
                 .vehicle = vehicle,
                 .reception = measurement,
                 .range = {},
                 .state = outputs.health.state,
                 .steps_taken = outputs.health.steps_taken});
      ASSERT_TRUE(outputs.setpoint);
      const NorthEast before = vehicle.position;
      vehicle = vehicle::advance_for(vehicle, {outputs.setpoint->heading, outputs.setpoint->speed, outputs.setpoint->depth}, {},
                                     search::kMeasurementInterval);
      surroundings.pass(world, vehicle.position - before, search::kMeasurementInterval.to_seconds());
    }
    detections += score.detections();
  }

  search::SearchSettings settings;
  search::Conditions conditions;
  search::Soundscape soundscape{std::vector{sonar::SnrCurve(Meters{1'000.0}, {18.0F})}};
  std::uint32_t detections = 0;
};

struct Distribution {
  double heard_share = 0.0;
  double mean_db = 0.0;    ///< of what was heard
  double spread_db = 0.0;  ///< standard deviation
  double detections = 0.0;
};

Distribution distribution_of(const std::vector<policy::Reception>& receptions) {
  Distribution d;
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const policy::Reception& h : receptions) {
    if (h.too_faint) continue;
    count += 1.0;
    sum += h.snr.value;
    squares += h.snr.value * h.snr.value;
    if (h.snr.value >= 10.0) d.detections += 1.0;
  }
  d.heard_share = count / static_cast<double>(receptions.size());
  d.mean_db = sum / count;
  d.spread_db = std::sqrt(squares / count - d.mean_db * d.mean_db);
  return d;
}

TEST_P(ListeningAgreement, OfFlightAndEnvironmentIsWithinWhatChanceMakesOfBoth) {
  // Of 1200 s a pulse falls into the last W for 885 + W (into the last second for 60). Of W = 30 s with a pulse, 885 have two and 30 one;
  // the larger of two normal numbers lies 1/sqrt(pi) above their mean, and either has a variance of 1 - 1/pi about that.
  const bool is_newest = GetParam().listening == Listening::kNewest;
  const bool is_loudest = GetParam().listening == Listening::kLoudest;
  const double share = is_newest ? 60.0 / 1'200.0 : 915.0 / 1'200.0;
  const double two = 885.0 / 915.0;
  const double mean = is_loudest ? two / std::sqrt(M_PI) : 0.0;
  const double square = is_newest ? 1.0 : is_loudest ? 1.0 : two * 0.5 + (1.0 - two);
  const double spread = std::sqrt(square - mean * mean);

  for (const bool is_flight : {false, true}) {
    detections = 0;
    const std::vector<policy::Reception> receptions = is_flight ? receptions_in_flight() : receptions_in_the_environment();
    ASSERT_EQ(receptions.size(), kSearches * kSteps);
    const Distribution d = distribution_of(receptions);
    const double count = share * static_cast<double>(receptions.size());
    const auto* const where = is_flight ? "in flight" : "in the environment";
    // Five standard errors each; the searches cover their songs evenly, so the share's is smaller than this.
    EXPECT_NEAR(d.heard_share, share, 5.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(receptions.size()))) << where;
    EXPECT_NEAR(d.mean_db, 18.0 + kFluctuation_db * mean, 5.0 * kFluctuation_db * spread / std::sqrt(count)) << where;
    EXPECT_NEAR(d.spread_db, kFluctuation_db * spread, 5.0 * kFluctuation_db * spread / std::sqrt(2.0 * count)) << where;
    EXPECT_EQ(detections, d.detections) << where << ": what is scored is what was decided by";
  }
}

using ListeningAgreementOnShortLegs = ListeningAgreement;

TEST_P(ListeningAgreementOnShortLegs, ReachesBackToTheBeginningOfALegAndNoFurther) {
  constexpr double kLeg_s = 100.0;  // shorter than the window; in flight a second more or less
  const double share = (885.0 + kLeg_s) / 1'200.0;
  for (const bool is_flight : {false, true}) {
    detections = 0;
    const Distribution d = distribution_of(is_flight ? receptions_in_flight() : receptions_in_the_environment());
    EXPECT_NEAR(d.heard_share, share, 5.0 * std::sqrt(share * (1.0 - share) / (kSearches * kSteps)));  // five standard errors
    EXPECT_EQ(detections, d.detections);
  }
}

INSTANTIATE_TEST_SUITE_P(TwoMinutes, ListeningAgreementOnShortLegs,
                         testing::Values(config::ListeningWindow{.listening = Listening::kLoudest, .length = Duration::seconds(120)}));
INSTANTIATE_TEST_SUITE_P(Windows, ListeningAgreement,
                         testing::Values(config::ListeningWindow{},
                                         config::ListeningWindow{.listening = Listening::kLoudest, .length = Duration::seconds(30)},
                                         config::ListeningWindow{.listening = Listening::kMean, .length = Duration::seconds(30)}),
                         [](const auto& tested) {
                           return std::string(config::kListeningWords[static_cast<std::size_t>(tested.param.listening)]);
                         });

}  // namespace
}  // namespace earshot::fly
