#include "firmware/runtime/known_steps.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "firmware/detector/snr_window.hpp"
#include "firmware/guidance/leg.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

constexpr int kSteps = 32;
constexpr std::size_t kActions = 8;
/// Of all that the steps give: GCC 12 and Clang 16 on x86-64, baseline and x86-64-v3, agree.
constexpr std::uint32_t kFingerprint = 0xF3048830;

class Fingerprint {
 public:
  void add(float x) { add_bits(std::bit_cast<std::uint32_t>(x)); }
  void add(double x) { add_bits(std::bit_cast<std::uint64_t>(x)); }
  void add(NorthEast place) {
    add(place.north.value);
    add(place.east.value);
  }
  void add_bits(std::uint64_t bits) {
    std::array<std::uint8_t, sizeof(bits)> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (8U * i));
    crc_ = crc32(bytes, crc_);
  }
  [[nodiscard]] std::uint32_t value() const { return crc_; }

 private:
  std::uint32_t crc_ = 0;
};

config::Mission known_mission() {
  config::Mission mission;
  mission.operating_area = {.south_west = {Meters{-1'000.0}, Meters{2'000.0}}, .north_east = {Meters{19'000.0}, Meters{27'000.0}}};
  mission.edge_margin = Meters{250.0};
  mission.step_length = Meters{1'000.0};
  mission.search_speed = MetersPerSecond{2.0};
  mission.search_depth = Meters{300.0};
  mission.max_depth = Meters{400.0};
  return mission;
}

/// Anywhere in the area of `mission`.
NorthEast some_place(const config::Mission& mission, Pcg32& random) {
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  const double north = random.uniform_double();
  return mission.operating_area.south_west + NorthEast{.north = size.north * north, .east = size.east * random.uniform_double()};
}

/// The mean of some measurements.
double known_mean(Pcg32& random) {
  detector::SnrWindow snr_window;
  Time now{1'000'000};
  for (int measurement = 0; measurement < 5; ++measurement) {
    now = now + Duration::seconds(1);
    const Decibels level{40.0 * random.uniform_double() - 20.0};
    const bool too_faint = measurement == 2;  // under a floor so low that it cuts off none of the others
    snr_window.take({.time = now, .snr = too_faint ? Decibels{-40.0} : level, .too_faint = too_faint});
  }
  return snr_window.reception({config::Listening::kMean, Duration::seconds(30)}, now).snr.value;
}

std::size_t known_action(Pcg32& random, Fingerprint& fingerprint) {
  std::array<float, kActions> logits{};
  std::array<float, kActions> probabilities{};
  for (float& logit : logits) logit = 8.0F * random.uniform_float() - 4.0F;
  policy::softmax(logits, probabilities);
  for (const float probability : probabilities) fingerprint.add(probability);
  return policy::draw_action(policy::ActionDraw::kSampled, logits, random);
}

/// From a place of its own towards one of eight directions, seen half-way and to one side.
void fly_known_leg(const config::Mission& mission, std::size_t action, Pcg32& random, Fingerprint& fingerprint) {
  constexpr double kDiagonal = 0.70710678118654757;
  constexpr std::array<UnitNorthEast, kActions> kDirections{{{1.0, 0.0},
                                                             {kDiagonal, kDiagonal},
                                                             {0.0, 1.0},
                                                             {-kDiagonal, kDiagonal},
                                                             {-1.0, 0.0},
                                                             {-kDiagonal, -kDiagonal},
                                                             {0.0, -1.0},
                                                             {kDiagonal, -kDiagonal}}};
  const NorthEast place = some_place(mission, random);
  const safety::SafeWaypoint safe = safety::safe_waypoint(mission, place, place + mission.step_length * kDirections[action]);
  const guidance::Leg leg(place, safe.waypoint);
  const NorthEast beside =
      place + NorthEast{.north = Meters{300.0 * random.uniform_double()}, .east = Meters{-200.0 * random.uniform_double()}};
  fingerprint.add_bits(action);
  fingerprint.add(safe.waypoint);
  fingerprint.add(leg.length().value);
  fingerprint.add(leg.along_track(beside).value);
  fingerprint.add(leg.cross_track(beside).value);
  const messages::Setpoint wanted{
      .heading = leg.heading_to_steer(beside), .speed = mission.search_speed, .depth = mission.search_depth, .waypoint = leg.waypoint()};
  const safety::SafeSetpoint setpoint =
      safety::safe_setpoint(mission, {.time = {}, .position = beside, .depth = {}, .heading = wanted.heading, .speed = {}}, wanted, {});
  fingerprint.add(setpoint.setpoint.heading.value);
  fingerprint.add(setpoint.setpoint.depth.value);
}

}  // namespace

bool repeats_known_steps() {
  const config::Mission mission = known_mission();
  Pcg32 random(20);
  Fingerprint fingerprint;
  for (int step = 0; step < kSteps; ++step) {
    fingerprint.add(known_mean(random));
    fly_known_leg(mission, known_action(random, fingerprint), random, fingerprint);
  }
  return fingerprint.value() == kFingerprint;
}

}  // namespace earshot::runtime
