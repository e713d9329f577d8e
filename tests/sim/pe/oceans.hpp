#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/pe/short_section.hpp"

namespace earshot::pe::tests {

/// An ocean that the automatic grid must serve.
struct Ocean {
  std::string name;
  ShortSection section;
  double frequency_hz;
  double source_depth_m;
  std::vector<double> receiver_depth_m;
  double max_range_m;
};

/// For GoogleTest.
inline void PrintTo(const Ocean& ocean, std::ostream* stream) {
  *stream << ocean.name;
}

inline std::pair<double, ocean::SoundSpeedProfile> isovelocity() {
  return {0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}};
}
inline std::pair<double, ocean::SoundSpeedProfile> munk(double range_m = 0.0, double axis_m = 1300.0) {
  return {range_m, ocean::MunkProfile{MetersPerSecond{1500.0}, Meters{axis_m}, Meters{1300.0}, 0.00737}};
}
inline std::pair<double, std::vector<SedimentPoint>> bottom(double sound_speed_mps, double density, double attenuation) {
  return {0.0, {{0.0, sound_speed_mps, density, attenuation}}};
}

/// Uniform water over sand, with a sea floor of constant slope between two depths.
inline Ocean slope(std::string name, double from_m, double to_m, double tangent, double frequency_hz) {
  const double length_m = std::abs(to_m - from_m) / tangent;
  return {.name = std::move(name),
          .section = {.floor = {{0.0, from_m}, {500.0, from_m}, {500.0 + length_m, to_m}},
                      .water = {isovelocity()},
                      .sediment = {bottom(1700.0, 1.5, 0.5)}},
          .frequency_hz = frequency_hz,
          .source_depth_m = 0.5 * std::min(from_m, to_m),
          .receiver_depth_m = {0.3 * std::min(from_m, to_m), 0.8 * std::min(from_m, to_m)},
          .max_range_m = 500.0 + length_m + 1500.0};
}

/// The oceans of tests/reference/pe, each at its own frequency and at half and twice that.
inline std::vector<Ocean> reference_oceans() {
  std::vector<Ocean> oceans;
  for (const double factor : {1.0, 0.5, 2.0}) {
    const std::string at = factor == 1.0 ? "" : (factor < 1.0 ? ", half the frequency" : ", twice the frequency");
    oceans.push_back({"paper's ocean" + at,
                      {.floor = {{0.0, 3000.0}}, .water = {munk()}, .sediment = {bottom(1505.0, 1.5, 0.5)}},
                      20.0 * factor,
                      30.0,
                      {300.0},
                      25'000.0});
    oceans.push_back({"Pekeris" + at,
                      {.floor = {{0.0, 100.0}}, .water = {isovelocity()}, .sediment = {bottom(1700.0, 1.5, 0.5)}},
                      100.0 * factor,
                      36.0,
                      {46.0},
                      20'000.0});
    oceans.push_back({"ASA wedge" + at,
                      {.floor = {{0.0, 200.0}, {4'000.0, 0.0}}, .water = {isovelocity()}, .sediment = {bottom(1700.0, 1.5, 0.5)}},
                      25.0 * factor,
                      100.0,
                      {30.0},
                      3'800.0});
    oceans.push_back({"deep slope" + at,
                      {.floor = {{0.0, 3000.0}, {5'000.0, 3000.0}, {25'000.0, 1000.0}, {35'000.0, 1000.0}},
                       .water = {munk()},
                       .sediment = {bottom(1600.0, 1.8, 0.5)}},
                      20.0 * factor,
                      30.0,
                      {100.0, 300.0, 800.0},
                      factor > 1.0 ? 20'000.0 : 35'000.0});
  }
  return oceans;
}

/// Oceans without a full-wave reference: other slopes, both ways; water that changes with range; slow, layered and hard bottoms.
inline std::vector<Ocean> further_oceans() {
  const Ocean deep = reference_oceans()[3];
  const auto deep_with = [&deep](std::string name, std::vector<std::pair<double, double>> floor, double max_range_m) {
    Ocean ocean = deep;
    ocean.name = std::move(name);
    ocean.section.floor = std::move(floor);
    ocean.max_range_m = max_range_m;
    ocean.receiver_depth_m = {100.0, 300.0};
    return ocean;
  };
  std::vector<Ocean> oceans;
  oceans.push_back(slope("up 1 degree", 200.0, 100.0, 0.0175, 50.0));
  oceans.push_back(slope("down 1 degree", 100.0, 200.0, 0.0175, 50.0));
  oceans.push_back(slope("down 3 degrees", 100.0, 300.0, 0.0524, 50.0));
  oceans.push_back(slope("up 6 degrees", 300.0, 100.0, 0.1, 50.0));
  oceans.push_back(slope("down 6 degrees", 100.0, 300.0, 0.1, 50.0));
  oceans.push_back(slope("up 10 degrees", 500.0, 150.0, 0.1763, 50.0));
  oceans.push_back(slope("down 10 degrees", 150.0, 500.0, 0.1763, 50.0));
  oceans.push_back(slope("up 20 degrees", 800.0, 150.0, 0.364, 50.0));
  oceans.push_back(slope("down 20 degrees", 150.0, 800.0, 0.364, 50.0));
  oceans.push_back(deep_with("deep, down 6 degrees", {{0.0, 1000.0}, {5'000.0, 1000.0}, {25'000.0, 3000.0}}, 35'000.0));
  oceans.push_back(deep_with("seamount", {{0.0, 3000.0}, {10'000.0, 3000.0}, {15'000.0, 800.0}, {20'000.0, 3000.0}}, 35'000.0));
  oceans.push_back(deep_with("shelf break", {{0.0, 400.0}, {15'000.0, 400.0}, {25'000.0, 2400.0}}, 40'000.0));
  oceans.push_back(
      deep_with("hills", {{0.0, 2500.0}, {4'000.0, 2300.0}, {8'000.0, 2700.0}, {12'000.0, 2200.0}, {16'000.0, 2600.0}, {25'000.0, 2400.0}},
                25'000.0));
  Ocean front = deep_with("front", {{0.0, 3000.0}}, 50'000.0);
  front.section.water = {munk(), munk(20'000.0), munk(30'000.0, 1000.0)};
  oceans.push_back(front);
  Ocean far = deep_with("50 Hz to 100 km", {{0.0, 3000.0}}, 100'000.0);
  far.frequency_hz = 50.0;
  oceans.push_back(far);
  Ocean near = deep_with("100 Hz to 10 km", {{0.0, 3000.0}}, 10'000.0);
  near.frequency_hz = 100.0;
  oceans.push_back(near);
  Ocean clay = deep_with("slow clay", {{0.0, 2000.0}}, 50'000.0);
  clay.section.sediment = {bottom(1470.0, 1.4, 0.02)};
  oceans.push_back(clay);
  Ocean shallow_clay = slope("slow clay on a shelf", 150.0, 100.0, 0.01, 100.0);
  shallow_clay.section.sediment = {bottom(1460.0, 1.4, 0.05)};
  oceans.push_back(shallow_clay);
  Ocean layers = slope("layers with gradients, upslope", 250.0, 150.0, 0.03, 50.0);
  layers.section.sediment = {
      {0.0,
       {{0.0, 1480.0, 1.4, 0.1}, {30.0, 1600.0, 1.6, 0.3}, {30.0, 1750.0, 1.9, 0.5}, {80.0, 1850.0, 2.0, 0.4}, {80.0, 2200.0, 2.2, 0.1}}}};
  oceans.push_back(layers);
  Ocean rock = slope("rock", 200.0, 150.0, 0.02, 100.0);
  rock.section.sediment = {bottom(3000.0, 2.4, 0.1)};
  oceans.push_back(rock);
  Ocean high = slope("1 kHz on a shelf", 60.0, 50.0, 0.01, 1'000.0);
  oceans.push_back(high);
  Ocean low = deep_with("5 Hz", deep.section.floor, 35'000.0);
  low.frequency_hz = 5.0;
  oceans.push_back(low);
  return oceans;
}

}  // namespace earshot::pe::tests
