#include "tests/bits/inputs.hpp"

#include <algorithm>

namespace earshot::bits {
namespace {

constexpr Time time_of(std::int32_t second) {
  return {Duration::seconds(second).us};
}

double meters(std::int64_t units) {
  return static_cast<double>(units) * kPlaceUnit_m;
}

/// Sine of one turn, of which half is here, times 32767.
constexpr int kPeriod = kSampleRate_hz / 20;
constexpr std::array<std::int32_t, kPeriod / 2> kSine{0,     4107,  8149,  12062, 15786, 19260, 22431, 25247, 27666,
                                                      29648, 31163, 32187, 32702, 32702, 32187, 31163, 29648, 27666,
                                                      25247, 22431, 19260, 15786, 12062, 8149,  4107};

std::int64_t sine(std::int64_t sample) {
  const auto at = static_cast<std::size_t>(sample % kPeriod);
  return at < kSine.size() ? kSine[at] : -kSine[at - kSine.size()];
}

/// Of the pulse, in units of 2^-23 of full scale: half as loud every 711 m, in between on a straight line.
std::int64_t amplitude_at(const Place& vehicle) {
  constexpr std::int64_t kAtSource = 2'930'000;
  constexpr std::int64_t kHalf = 711 * 1024;
  const std::int64_t north = vehicle.north - kSource.north;
  const std::int64_t east = vehicle.east - kSource.east;
  const std::int64_t range = whole_root(north * north + east * east);
  const std::int64_t nearer = kAtSource >> (range / kHalf);
  return nearer - nearer * (range % kHalf) / (2 * kHalf);
}

}  // namespace

std::int64_t whole_root(std::int64_t square) {
  std::int64_t root = 0;
  for (std::int64_t bit = std::int64_t{1} << 30; bit > 0; bit >>= 1)
    if ((root + bit) * (root + bit) <= square) root += bit;
  return root;
}

void Vehicle::head_for(const Corner& corner) {
  from_ = place_;
  corner_ = corner;
  const std::int64_t north = corner.north - from_.north;
  const std::int64_t east = corner.east - from_.east;
  length_ = whole_root(north * north + east * east);
  travelled_ = 0;
}

void Vehicle::move() {
  if (length_ == 0) return;
  travelled_ += kSpeed;
  place_ = {from_.north + (corner_.north - from_.north) * travelled_ / length_,
            from_.east + (corner_.east - from_.east) * travelled_ / length_};
}

messages::Navigation Vehicle::navigation(std::int32_t second) const {
  const std::int32_t depth_m = std::min<std::int32_t>(300, 4 * second);
  return {.time = time_of(second),
          .position = {Meters{meters(place_.north)}, Meters{meters(place_.east)}},
          .depth = Meters{static_cast<double>(depth_m)},
          .heading = Radians{corner_.heading * kAngleUnit_rad},
          .speed = MetersPerSecond{length_ == 0 ? 0.0 : 10.0}};
}

messages::VehicleStatus Vehicle::status(std::int32_t second) const {
  return {
      .time = time_of(second), .altitude = Meters{2'700.0 + static_cast<double>(second % 64)}, .battery_percent = 100.0 - second * 0.125};
}

messages::BearingMeasurement Vehicle::bearing(std::int32_t second) const {
  constexpr double kMirror_rad = 0.75;
  messages::Bearing bearing{.direction = Radians{corner_.bearing * kAngleUnit_rad}, .deviation = Radians{0.125}};
  if (second % 4 == 0) bearing.mirror_axis = Radians{kMirror_rad};
  return {.time = time_of(second), .bearing = bearing, .sender = 7};
}

void Sea::hear(std::int32_t second, const Place& vehicle, Samples& samples) {
  constexpr int kBetweenPulses_s = 15;
  constexpr std::int64_t kFullScale = (std::int64_t{1} << 23) - 1;
  const bool has_pulse = second % kBetweenPulses_s == 0;
  const std::int64_t chance = 768 + (random_.next() >> 23U);  // of 1024: 0.75 to 1.25
  const std::int64_t amplitude = has_pulse ? amplitude_at(vehicle) * chance / 1024 : 0;
  for (float& sample : samples) {
    const std::uint32_t one = random_.next();
    const std::uint32_t other = random_.next();
    const std::int64_t noise =
        std::int64_t{one >> 16U} + std::int64_t{one & 0xFFFFU} + std::int64_t{other >> 16U} + std::int64_t{other & 0xFFFFU} - 2 * 65'535;
    const std::int64_t sound = std::clamp(noise + sine(sample_) * amplitude / 32'768, -kFullScale, kFullScale);
    sample = static_cast<float>(sound) * 0x1p-23F;
    ++sample_;
  }
  constexpr std::int32_t kKnock_s = 345;
  if (second == kKnock_s) samples[500] = 1.0F;
}

std::optional<messages::OperatorCommand> order_of(std::int32_t second) {
  using messages::Order;
  struct Given {
    std::int32_t second;
    Order order;
  };
  constexpr std::array<Given, 4> kOrders{{{3, Order::kStart}, {200, Order::kPause}, {212, Order::kResume}, {260, Order::kTighten}}};
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    if (kOrders[i].second != second) continue;
    messages::OperatorCommand command{.time = time_of(second),
                                      .expiry = time_of(second + 600),
                                      .issuer = 1,
                                      .number = static_cast<std::uint32_t>(i + 1),
                                      .order = kOrders[i].order};
    if (command.order == Order::kTighten) command.limits.max_depth = Meters{310.0};
    return command;
  }
  return std::nullopt;
}

bool is_lost(std::int32_t second) {
  return second == 300;
}

Decibels gain_of(std::int32_t second) {
  return Decibels{second >= 150 ? 6.0 : 0.0};
}

}  // namespace earshot::bits
