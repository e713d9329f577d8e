#include "sim/ocean/file/ram/ram_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "firmware/host/text/numbers.hpp"

namespace earshot::ocean::ram {
namespace {

using host::Range;

constexpr double kMaxDepth_m = 12'000.0;
constexpr double kMaxRange_m = 2'000'000.0;
constexpr std::size_t kMostPoints = 100'000;
constexpr std::size_t kMostBlocks = 10'000;
constexpr double kMostSteps = 1e6;

const Range kSoundSpeed_mps = Range::between(300.0, 8000.0);
const Range kDensity_g_per_cm3 = Range::between(0.1, 20.0);
const Range kAttenuation_db_per_wavelength = Range::between(0.0, 20.0);

/// One line of so many numbers, all of which must be there.
template <std::size_t kCount>
std::array<double, kCount> read_line(ListReader& file, const std::string& what) {
  std::array<double, kCount> values{};
  const std::size_t read = file.numbers(values, what);
  if (read < kCount) throw file.error(what, host::counted(read, "number"), "must be " + std::to_string(kCount));
  return values;
}

std::size_t whole(const ListReader& file, const std::string& what, double value) {
  file.require(what, value, Range::between(1.0, 1e6));
  if (value != std::floor(value)) throw file.error(what, value, "must be a whole number");
  return static_cast<std::size_t>(value);
}

DepthProfile read_profile(ListReader& file, const std::string& what, Range allowed, double depth_step_m) {
  DepthProfile profile;
  while (profile.depth_m.size() < kMostPoints) {
    auto [depth_m, value] = read_line<2>(file, "depth and " + what);
    if (depth_m < 0.0 && !profile.depth_m.empty()) return profile;
    file.require("depth of " + what + " in m", depth_m, Range::between(0.0, 1e6));
    file.require(what, value, allowed);
    if (!profile.depth_m.empty() && depth_m == profile.depth_m.back()) depth_m += depth_step_m;
    if (!profile.depth_m.empty() && !(depth_m > profile.depth_m.back()))
      throw file.error("depth of " + what + " in m", depth_m, "must be more than on the line before");
    profile.depth_m.push_back(depth_m);
    profile.value.push_back(value);
  }
  throw file.error("points of " + what, static_cast<double>(kMostPoints), "there must not be more, up to a line of -1 -1");
}

std::vector<SeaFloorStation> read_sea_floor(ListReader& file, double max_depth_m) {
  std::vector<SeaFloorStation> stations;
  while (stations.size() < kMostPoints) {
    const auto [range_m, depth_m] = read_line<2>(file, "range and depth of the sea floor");
    if (range_m < 0.0 && !stations.empty()) return stations;
    file.require("range of the sea floor in m", range_m, Range::between(0.0, 1e8));
    file.require("depth of the sea floor in m", depth_m, Range::above_up_to(0.0, std::min(max_depth_m, kMaxDepth_m)));
    if (stations.empty() && range_m != 0.0) throw file.error("range of the sea floor in m", range_m, "the first must be 0");
    if (!stations.empty() && !(Meters{range_m} > stations.back().range))
      throw file.error("range of the sea floor in m", range_m, "must be more than on the line before");
    stations.push_back({.range = Meters{range_m}, .depth = Meters{depth_m}});
  }
  throw file.error("points of the sea floor", static_cast<double>(kMostPoints), "there must not be more, up to a line of -1 -1");
}

Block read_block(ListReader& file, double range_m, double depth_step_m) {
  return {.range_m = range_m,
          .water_speed_mps = read_profile(file, "sound speed of the water in m/s", kSoundSpeed_mps, depth_step_m),
          .sediment_speed_mps = read_profile(file, "sound speed of the sediment in m/s", kSoundSpeed_mps, depth_step_m),
          .sediment_density_g_per_cm3 = read_profile(file, "density of the sediment in g/cm3", kDensity_g_per_cm3, depth_step_m),
          .sediment_attenuation_db_per_wavelength =
              read_profile(file, "attenuation of the sediment in dB per wavelength", kAttenuation_db_per_wavelength, depth_step_m)};
}

/// RAM takes one step beyond the first, and then steps until it is at rmax.
std::size_t steps_of(const ListReader& file, const RamInput& input) {
  const double steps = std::max(2.0, std::ceil(input.max_range_m / input.range_step_m - 1e-6));
  if (!(steps <= kMostSteps)) throw file.error("rmax in m", input.max_range_m, "must not be more than a million steps dr");
  return static_cast<std::size_t>(steps);
}

void read_head(ListReader& file, RamInput& input) {
  const auto source = read_line<3>(file, "frequency, source depth and receiver depth");
  file.require("frequency in Hz", source[0], Range::between(1.0, 10'000.0));
  file.require("source depth in m", source[1], Range::above_up_to(0.0, kMaxDepth_m));
  input.frequency_hz = source[0];
  input.source_depth_m = source[1];

  const auto ranges = read_line<3>(file, "rmax, dr and ndr");
  file.require("rmax in m", ranges[0], Range::above_up_to(0.0, kMaxRange_m));
  file.require("dr in m", ranges[1], Range::between(0.01, 10'000.0));
  input.max_range_m = ranges[0];
  input.range_step_m = ranges[1];
  input.range_steps = steps_of(file, input);
  input.range_every = whole(file, "ndr", ranges[2]);
  if (input.range_every > input.range_steps)
    throw file.error("ndr", ranges[2],
                     "must not exceed the " + std::to_string(input.range_steps) + " steps up to rmax: no range is written");

  const auto depths = read_line<4>(file, "zmax, dz, ndz and zmplt");
  file.require("zmax in m", depths[0], Range::above_up_to(0.0, 1e6));
  file.require("dz in m", depths[1], Range::between(0.001, 1000.0));
  file.require("zmplt in m", depths[3], Range::above_up_to(0.0, 1e6));
  input.max_depth_m = depths[0];
  input.depth_step_m = depths[1];
  input.depth_every = whole(file, "ndz", depths[2]);
  input.written_depth_m = depths[3];
}

}  // namespace

double DepthProfile::at(double depth) const {
  const auto above = std::upper_bound(depth_m.begin(), depth_m.end(), depth);
  if (above == depth_m.begin()) return value.front();
  if (above == depth_m.end()) return value.back();
  const auto i = static_cast<std::size_t>(above - depth_m.begin());
  return std::lerp(value[i - 1], value[i], (depth - depth_m[i - 1]) / (depth_m[i] - depth_m[i - 1]));
}

RamInput read_ram_input(const std::filesystem::path& path) {
  ListReader file(path);
  RamInput input{};
  input.title = file.line("title");
  read_head(file, input);
  (void)read_line<4>(file, "c0, np, ns and rs");  // how RAM computes
  input.sea_floor = read_sea_floor(file, input.max_depth_m);
  if (const double floor_m = input.sea_floor.front().depth.value; !(input.source_depth_m < floor_m))
    throw file.error("source depth in m", input.source_depth_m, "must be above the sea floor, at " + host::shortest(floor_m));
  input.blocks.push_back(read_block(file, 0.0, input.depth_step_m));
  while (!file.at_end()) {
    const double range_m = file.number("range of the next profiles in m", Range::at_least(0.0));
    if (!(range_m > input.blocks.back().range_m))
      throw file.error("range of the next profiles in m", range_m, "must be more than that before");
    if (input.blocks.size() == kMostBlocks)
      throw file.error("range of the next profiles in m", range_m, "there must not be more than " + std::to_string(kMostBlocks));
    input.blocks.push_back(read_block(file, range_m, input.depth_step_m));
  }
  return input;
}

}  // namespace earshot::ocean::ram
