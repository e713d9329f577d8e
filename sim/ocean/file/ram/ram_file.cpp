#include "sim/ocean/file/ram/ram_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "firmware/host/file/file_checksum.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/ocean/file/ram/ram_input.hpp"
#include "sim/ocean/file/ram/sediment_below.hpp"

namespace earshot::ocean::ram {
namespace {

constexpr std::size_t kMostReceivers = 1'000'000;

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what, double value, const std::string& must) {
  throw host::BadInput(path.string() + ": " + what + " = " + host::shortest(value) + ": " + must);
}

TabulatedProfile table_of(const DepthProfile& profile) {
  TabulatedProfile table{.depth_m = profile.depth_m, .sound_speed_mps = profile.value};
  if (table.depth_m.front() > 0.0) {
    table.depth_m.insert(table.depth_m.begin(), 0.0);
    table.sound_speed_mps.insert(table.sound_speed_mps.begin(), table.sound_speed_mps.front());
  }
  return table;
}

/// RAM's water changes from one step to the next, Earshot's linearly between stations: within one step, too.
std::vector<WaterStation> water_stations(const RamInput& input) {
  std::vector<WaterStation> stations;
  for (const Block& block : input.blocks) {
    const Meters last{block.range_m - input.range_step_m};
    if (!stations.empty() && last > stations.back().range) stations.push_back({.range = last, .profile = stations.back().profile});
    stations.push_back({.range = Meters{block.range_m}, .profile = table_of(block.water_speed_mps)});
  }
  return stations;
}

/// Of the nodes i = ndz, 2 ndz, ... up to zmplt / dz - 0.5, of which the first is at the surface.
std::vector<double> depths_of(const std::filesystem::path& path, const RamInput& input) {
  const double last = std::trunc(input.written_depth_m / input.depth_step_m - 0.5);
  const double count = std::floor(last / static_cast<double>(input.depth_every));
  if (!(count >= 1.0)) refuse(path, "zmplt", input.written_depth_m, "must hold one depth that is written, at least");
  if (!(count <= static_cast<double>(kMostReceivers)))
    refuse(path, "zmplt", input.written_depth_m, "must not hold a million depths that are written");
  std::vector<double> depth_m;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(count); ++k)
    depth_m.push_back(static_cast<double>(k * input.depth_every - 1) * input.depth_step_m);
  return depth_m;
}

/// After every ndr-th step.
std::vector<double> ranges_of(const RamInput& input) {
  std::vector<double> range_m;
  for (std::size_t step = input.range_every; step <= input.range_steps; step += input.range_every)
    range_m.push_back(static_cast<double>(step) * input.range_step_m);
  return range_m;
}

}  // namespace

RadialCase load_ram(const std::filesystem::path& path) {
  constexpr double kSlow_mps = 1500.0;
  constexpr double kPartsOfWavelength = 20.0;
  const RamInput input = read_ram_input(path);
  RadialCase result;
  Environment& environment = result.environment;
  environment.name = input.title.empty() ? "RAM" : host::printable(input.title);
  environment.source = {.frequency = Hertz{input.frequency_hz}, .level = {}, .depth = Meters{input.source_depth_m}, .position = {}};
  environment.seabed.depth = input.sea_floor.front().depth;
  if (input.sea_floor.size() > 1) environment.sea_floor_stations = input.sea_floor;
  environment.water = table_of(input.blocks.front().water_speed_mps);
  if (input.blocks.size() > 1) environment.water_stations = water_stations(input);
  std::vector<SedimentStation> sediment =
      sediment_stations(input, std::max(input.depth_step_m, kSlow_mps / input.frequency_hz / kPartsOfWavelength));
  environment.seabed.layers = sediment.front().layers;
  if (sediment.size() > 1) environment.sediment_stations = std::move(sediment);
  environment.file_crc32 = host::crc32_of_file(path);
  environment.files = {path};
  result.receiver_depth_m = depths_of(path, input);
  result.receiver_range_m = ranges_of(input);
  return result;
}

}  // namespace earshot::ocean::ram
