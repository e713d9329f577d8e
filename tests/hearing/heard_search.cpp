#include "tests/hearing/heard_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/runtime/runtime.hpp"
#include "sim/apps/fly/flight_record.hpp"
#include "sim/hydrophone/hydrophone.hpp"
#include "sim/search/episode/episode.hpp"
#include "sim/search/scenario/surroundings.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hearing {
namespace {

using messages::MissionState;
using messages::Order;

/// One detector of a vehicle that has several.
class Detector {
 public:
  explicit Detector(const detector::SoundSettings& settings)
      : integration_s_(settings.integration_time.to_seconds()), detector_(std::make_unique<detector::SoundDetector>()) {
    if (detector_->configure(settings) != Status::kOk) std::abort();
  }

  void hear(const hydrophone::Hydrophone& sea, const std::vector<double>& modelled_db) {
    newest_.clear();
    detector_->hear(sea.block(), sea.samples());
    while (const auto estimate = detector_->next()) {
      if (!estimate->is_snr_measurement()) continue;  // as the vehicle hands over its measurements
      newest_.push_back(estimate->measurement());
      const double end_s = (estimate->time - Time{}).to_seconds();
      measurements.push_back({.time_s = end_s,
                              .snr_db = estimate->snr.value,
                              .too_faint = estimate->too_faint,
                              .modelled_db = modelled_over(modelled_db, end_s)});
    }
  }
  [[nodiscard]] const std::vector<messages::SnrMeasurement>& newest() const { return newest_; }

  std::vector<Measurement> measurements;

 private:
  [[nodiscard]] double modelled_over(const std::vector<double>& modelled_db, double end_s) const {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::round(end_s - integration_s_)));
    const auto last = std::max(first, static_cast<std::size_t>(std::max(0.0, std::round(end_s))));
    double sum = 0.0;
    for (std::size_t i = first; i <= last; ++i) sum += std::pow(10.0, modelled_db[std::min(i, modelled_db.size() - 1)] / 10.0);
    return 10.0 * std::log10(sum / static_cast<double>(last - first + 1));
  }

  double integration_s_;
  std::unique_ptr<detector::SoundDetector> detector_;
  std::vector<messages::SnrMeasurement> newest_;
};

hydrophone::Hydrophone sea_of(const Rig& rig, const detector::SoundSettings& listening, std::uint64_t seed) {
  hydrophone::HydrophoneSettings settings;
  settings.band = {.low = listening.band.low, .high = listening.band.high};
  settings.noise_level = rig.plan.scenario.environment.noise_level;
  settings.calls = hydrophone::Tone{.frequency = rig.plan.scenario.environment.source.frequency};
  settings.full_scale = full_scale_level(listening.calibration, {});
  return {settings, seed};
}

class Flight {
 public:
  Flight(const Rig& rig, const std::vector<detector::SoundSettings>& detectors, std::uint64_t seed)
      : rig_(rig), runtime_(std::make_unique<runtime::Runtime>()), score_(rig.plan.search) {
    if (runtime_->configure(rig.plan.mission.mission, *rig.flown.policy.policy, *rig.flown.tables.tables) != Status::kOk) std::abort();
    const search::World calm(rig.world.settings, rig.world.expected());
    Pcg32 random(seed);
    search::Episode episode;
    const policy::ObservationModel sees_nothing;
    const auto no_tables = std::make_unique<policy::OceanTables>();
    episode.start(calm, sees_nothing, *no_tables, random);
    const config::Mission& mission = rig.plan.mission.mission;
    vehicle_ = {.position = episode.position(),
                .depth = mission.search_depth,
                .heading = {},
                .speed = detectors.empty() ? mission.search_speed : MetersPerSecond{}};
    command_ = {.heading = vehicle_.heading, .speed = vehicle_.speed, .depth = vehicle_.depth};
    surroundings_.start(rig.world, vehicle_.position, episode.source(), Pcg32(seed, 1));
    source_ = episode.source();
    for (const detector::SoundSettings& settings : detectors) detectors_.emplace_back(settings);
    if (!detectors.empty()) sea_.emplace(sea_of(rig, detectors.front(), seed));
  }

  Search run() {
    bool is_found = false;
    MissionState state = MissionState::kStandby;
    for (Time now; state == MissionState::kStandby || state == MissionState::kSearch; now = now + search::kMeasurementInterval) {
      const bool reached = range_between(vehicle_.position, source_) <= rig_.plan.search.step_length;
      if (listen(now) && state == MissionState::kStandby) order(now, Order::kStart);
      if (state == MissionState::kSearch && reached) order(now, Order::kComplete);
      take(now,
           messages::Navigation{
               .time = now, .position = vehicle_.position, .depth = vehicle_.depth, .heading = vehicle_.heading, .speed = vehicle_.speed});
      const runtime::Outputs outputs = runtime_->step(now);
      state = outputs.health.state;
      is_found = outputs.health.end_reason == messages::EndReason::kCompleted;
      score_.add(
          {.time = now, .vehicle = vehicle_, .reception = {}, .range = {}, .state = state, .steps_taken = outputs.health.steps_taken});
      if (outputs.setpoint) command_ = {outputs.setpoint->heading, outputs.setpoint->speed, outputs.setpoint->depth};
      vehicle_ = vehicle::advance_for(vehicle_, command_, {}, search::kMeasurementInterval);
    }
    Search search{.is_found = is_found, .reward = score_.reward(), .measurements = {}};
    for (Detector& one : detectors_) search.measurements.push_back(std::move(one.measurements));
    return search;
  }

 private:
  template <class Value>
  void take(Time now, const Value& value) {
    runtime_->take({.arrival = now, .port = 0, .sequence = 0, .value = value});
  }
  void order(Time now, Order order) {
    take(now, messages::OperatorCommand{.time = now, .expiry = now, .issuer = 1, .number = ++orders_, .order = order});
  }
  void give(Time now, const messages::SnrMeasurement& measurement) {
    take(now, measurement);
    score_.hear(measurement);
    has_heard_ = true;
  }

  /// @return whether it has heard anything so far
  bool listen(Time now) {
    const search::Arrivals arrivals = surroundings_.arrivals(rig_.world, vehicle_.position);
    if (!sea_) {
      give(now, {.time = now, .snr = arrivals[0].snr});
      return true;
    }
    modelled_db_.push_back(arrivals[0].snr.value);
    hydrophone::Situation situation{.arrivals = {}, .speed = vehicle_.speed};
    (void)situation.arrivals.push_back({.range = arrivals[0].range, .level = arrivals[0].snr + rig_.plan.scenario.environment.noise_level});
    if (modelled_db_.size() == 1) {
      sea_->begin(situation);
      return false;
    }
    if (!sea_->hear(situation, now)) std::abort();
    for (Detector& one : detectors_) one.hear(*sea_, modelled_db_);
    for (const messages::SnrMeasurement& measurement : detectors_.front().newest()) give(now, measurement);
    return has_heard_;
  }

  Rig rig_;
  std::unique_ptr<runtime::Runtime> runtime_;
  fly::Score score_;
  vehicle::State vehicle_;
  vehicle::Command command_;
  search::Surroundings surroundings_;
  NorthEast source_;
  std::vector<Detector> detectors_;
  std::optional<hydrophone::Hydrophone> sea_;
  std::vector<double> modelled_db_;  ///< of each tick
  std::uint32_t orders_ = 0;
  bool has_heard_ = false;
};

}  // namespace

Search fly_search(const Rig& rig, const std::vector<detector::SoundSettings>& detectors, std::uint64_t seed) {
  return Flight(rig, detectors, seed).run();
}

}  // namespace earshot::hearing
