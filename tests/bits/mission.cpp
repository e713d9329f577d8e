#include "tests/bits/mission.hpp"

#include <bit>

#include "firmware/core/math.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/golden.hpp"
#include "tests/bits/eight_directions.hpp"
#include "tests/bits/recorded.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::bits {
namespace {

constexpr double kSide_m = 7'500.0;  // 25 cells of a step
constexpr double kStep_m = 300.0;
constexpr std::uint16_t kCells = 25;  // so many a microcontroller has room for

config::Mission mission() {
  config::Mission mission;
  mission.operating_area = {.south_west = {}, .north_east = at(kSide_m, kSide_m)};
  mission.edge_margin = Meters{250.0};
  mission.search_depth = Meters{300.0};
  mission.max_depth = Meters{320.0};
  mission.search_speed = MetersPerSecond{10.0};
  mission.step_length = Meters{kStep_m};
  mission.max_steps = 14;
  mission.max_time = Duration::seconds(60'000);
  mission.navigation_timeout = Duration::seconds(5);
  mission.snr_timeout = Duration::seconds(60);
  mission.detection_threshold = Decibels{10.0};
  mission.listening = {config::Listening::kLoudest, Duration::seconds(20)};
  mission.action_seed = 20;
  mission.safety.safe_point = at(1'000.0, 1'000.0);
  mission.safety.vehicle.battery_percent_per_km = 1.5;
  for (const config::Rule& rule :
       {config::Rule{config::Condition::kBattery, 70.0, Duration::seconds(3), config::Response::kWarn, false},
        config::Rule{config::Condition::kBatteryAtHome, 50.0, Duration::seconds(5), config::Response::kWarn, false},
        config::Rule{config::Condition::kHeadingIgnored, 1.0, Duration::seconds(1), config::Response::kWarn, false}})
    static_cast<void>(mission.safety.rules.push_back(rule));
  return mission;
}

}  // namespace

/// What the network without a bias makes of numbers below a float's smallest normal one, 2^-126: a unit that takes them for zero makes
/// nothing of them.
void Mission::add_small_numbers() {
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, kEightDirections.size()> logits{};
  for (std::size_t i = 0; i < observation.size(); ++i) observation[i] = static_cast<float>(i + 1) * 0x1p-136F;
  policy::forward(policy_.network, std::span(observation).first(policy_.network.observation_size), logits);
  digest_.add(std::span<const float>(logits));
}

/// It sees a belief, and goes by a network whose weights were drawn: every part of the core has something to do.
void Mission::make_policy() {
  policy_.step_length = Meters{kStep_m};
  policy_.area_size = at(kSide_m, kSide_m);
  policy_.detection_threshold = Decibels{10.0};
  policy_.draw = policy::ActionDraw::kSampled;
  policy_.actions.clear();
  for (const UnitNorthEast& direction : kEightDirections) static_cast<void>(policy_.actions.push_back(direction));
  policy::BeliefModel& belief = policy_.observation.belief;
  belief.area_size = policy_.area_size;
  belief.step_length = policy_.step_length;
  belief.border_width = policy_.step_length;
  belief.detection_threshold = policy_.detection_threshold;
  belief.actions = policy_.actions;
  belief.cells_north = kCells;
  belief.cells_east = kCells;
  policy_.observation.listening = mission().listening;
  policy_.observation.spec = policy::belief_state(belief);

  policy::Network& network = policy_.network;
  network.observation_size = policy_.observation.spec.size();
  network.hidden_sizes = {64, 64};
  network.action_count = policy_.actions.size();
  Pcg32 random(77);
  const auto draw = [&random](const auto& layer, std::size_t outputs, std::size_t inputs) {
    std::ranges::fill(layer.bias, 0.0F);
    for (std::size_t output = 0; output < outputs; ++output)
      for (std::size_t input = 0; input < inputs; ++input) layer.weight(output, input) = 0.5F * random.uniform_float() - 0.25F;
  };
  draw(network.layer(0), 64, network.observation_size);
  draw(network.layer(1), 64, 64);
  draw(network.layer(2), network.action_count, 64);
  add_small_numbers();
  for (float& bias : network.layer(0).bias) bias = random.uniform_float() - 0.5F;
  for (float& bias : network.layer(1).bias) bias = random.uniform_float() - 0.5F;
  for (policy::GoldenTrajectory& trajectory : policy_.golden) {
    for (policy::GoldenStep& step : trajectory) {
      const double north = random.next() % 7'000;  // one after the other: compilers choose the order of arguments
      step.place = at(north, random.next() % 7'000);
      step.reception = {.snr = Decibels{static_cast<double>(random.next() % 50)}, .too_faint = random.next() % 4 == 0};
    }
  }
}

Status Mission::begin(Track track) {
  track_ = track;
  vehicle_ = {};
  sea_ = {};
  second_ = 0;
  next_corner_ = 0;
  inputs_ = 0;
  digest_ = {};
  speed_ = MetersPerSecond{0.0};
  now_ = {};
  make_policy();
  if (!policy::check(policy_).is_none()) return Status::kCorrupt;
  policy::record_golden(policy_, memory_, tables_);
  for (const policy::GoldenTrajectory& trajectory : policy_.golden)
    for (const policy::GoldenStep& step : trajectory) digest_.add(step, policy_.observation.spec.size(), policy_.actions.size());
  tables_.frequency = Hertz{20.0};
  tables_.receiver_depth = Meters{300.0};
  tables_.source_depth = {Meters{30.0}, Meters{30.0}};
  tables_.sea_depth = {Meters{3'000.0}, Meters{3'000.0}};
  for (std::size_t i = 0; i < tables_.tables.size(); ++i) tables_.tables[i].sea_depth_m = 3'000.0F;
  if (const Status status = detector_.configure(detector::fin_whale()); status != Status::kOk) return status;
  return runtime_.configure(mission(), policy_, tables_);
}

template <class Value>
void Mission::give(std::int32_t second, const Value& value) {
  const messages::Input input{.arrival = {Duration::seconds(second).us}, .port = 0, .sequence = inputs_++, .value = value};
  if (witness_ != nullptr) witness_->see(input);
  runtime_.take(input);
}

void Mission::take(const detector::Estimate& estimate, std::int32_t second) {
  digest_.add(estimate);
  if (!estimate.is_snr_measurement()) return;
  ++now_.measurements;
  give(second, estimate.measurement());
}

void Mission::listen(std::int32_t second) {
  sea_.hear(second, vehicle_.place(), samples_);
  if (is_lost(second)) return;
  const messages::HydrophoneBlock block{.time = {Duration::seconds(second - 1).us},
                                        .sequence = second,
                                        .first_sample = std::int64_t{second} * kSampleRate_hz,
                                        .sample_rate = Hertz{kSampleRate_hz},
                                        .gain = gain_of(second),
                                        .samples_per_channel = kSampleRate_hz,
                                        .overflow_count = 0,
                                        .channels = 1};
  detector_.note_motion(speed_, 0.0);
  detector_.hear(block, samples_);
  while (const std::optional<detector::Estimate> estimate = detector_.next()) take(*estimate, second);
}

Line Mission::line(const messages::Decision& decision) const {
  const auto units = [](double value, double unit) { return static_cast<std::int32_t>(value / unit); };
  const NorthEast to_source =
      at(static_cast<double>(kSource.north) * kPlaceUnit_m, static_cast<double>(kSource.east) * kPlaceUnit_m) - decision.position;
  const NorthEast leg = decision.waypoint - decision.position;
  double bearing = bearing_of(to_source.north.value, to_source.east.value).value;
  if (bearing < 0.0) bearing += 2.0 * 3.14159265358979323846;
  Line line = now_;
  line.step = decision.step;
  line.snr_bits = std::bit_cast<std::uint64_t>(decision.snr.value);
  line.action = decision.action;
  line.corner = {.second = second_,
                 .north = units(decision.waypoint.north.value, kPlaceUnit_m),
                 .east = units(decision.waypoint.east.value, kPlaceUnit_m),
                 .heading = units(bearing_of(leg.north.value, leg.east.value).value, kAngleUnit_rad),
                 .bearing = units(bearing, kAngleUnit_rad)};
  return line;
}

Line Mission::fly() {
  constexpr std::int32_t kStatusEvery_s = 5;
  constexpr std::int32_t kBearingEvery_s = 7;
  while (second_ < kSeconds) {
    ++second_;
    now_.second = second_;
    vehicle_.move();
    listen(second_);
    give(second_, vehicle_.navigation(second_));
    if (second_ % kStatusEvery_s == 0) give(second_, vehicle_.status(second_));
    if (second_ % kBearingEvery_s == 0 && next_corner_ > 0) give(second_, vehicle_.bearing(second_));
    if (const std::optional<messages::OperatorCommand> command = order_of(second_)) give(second_, *command);

    const runtime::Outputs outputs = runtime_.step({Duration::seconds(second_).us});
    if (witness_ != nullptr) witness_->see({Duration::seconds(second_).us}, outputs);
    digest_.add(outputs.health);
    for (const messages::SafetyEvent& event : outputs.safety_events) digest_.add(event);
    if (outputs.setpoint) {
      ++now_.setpoints;
      speed_ = outputs.setpoint->speed;
      digest_.add(*outputs.setpoint);
    }
    if (outputs.decision) digest_.add(*outputs.decision);
    now_.digest = digest_.value();
    const Line decided = outputs.decision ? line(*outputs.decision) : now_;
    if (track_ == Track::kFlown && outputs.decision) {
      vehicle_.head_for(decided.corner);
      ++next_corner_;
    }
    if (track_ == Track::kRecorded && next_corner_ < kTrack.size() && kTrack[next_corner_].second == second_)
      vehicle_.head_for(kTrack[next_corner_++]);
    if (outputs.decision) return decided;
  }
  now_.is_end = true;
  return now_;
}

bool is_as_recorded(std::size_t number, const Line& line) {
  return number < kDigests.size() && kDigests[number] == line.digest && line.is_end == (number + 1 == kDigests.size());
}

}  // namespace earshot::bits
