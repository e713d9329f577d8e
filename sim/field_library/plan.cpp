#include "sim/field_library/plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "firmware/host/file/file_checksum.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/charts/charts.hpp"
#include "sim/ocean/section_along.hpp"

namespace earshot::field_library {
namespace {

using host::Range;
using host::TableReader;

std::vector<NorthEast> read_positions(TableReader table) {
  const bool grid = table.choice("layout", {"grid", "list"}) == 0;
  const Range in_plane = Range::between(-kFurthestPosition_m, kFurthestPosition_m);
  const std::vector<double> north_m = table.numbers("north_m", in_plane);
  const std::vector<double> east_m = table.numbers("east_m", in_plane);
  std::vector<NorthEast> positions;
  if (!grid) {
    if (north_m.size() != east_m.size()) table.problem("east_m", "must have as many values as north_m");
    for (std::size_t i = 0; i < std::min(north_m.size(), east_m.size()); ++i) positions.push_back({Meters{north_m[i]}, Meters{east_m[i]}});
  } else if (north_m.size() * east_m.size() <= kMostPositions) {
    for (const double north : north_m) {
      for (const double east : east_m) positions.push_back({Meters{north}, Meters{east}});
    }
  }
  if (positions.empty() || positions.size() > kMostPositions) table.problem("north_m", "must make 1 to 1000000 positions with east_m");
  return positions;
}

std::vector<double> read_depths(TableReader& root, const char* key) {
  std::vector<double> depth_m = root.numbers(key, Range::above_up_to(0.0, 12'000.0));
  if (depth_m.empty() || !std::is_sorted(depth_m.begin(), depth_m.end(), std::less_equal<>{}))
    root.problem(key, "must be an increasing array of at least one depth");
  return depth_m;
}

/// The depth in the middle of the fan goes where the march begins, the others where it is read.
void read_all_depths(TableReader& root, Centre centre, sonar::RadialPlan& radial) {
  std::vector<double> source_m = read_depths(root, "source_depth_m");
  std::vector<double> receiver_m = read_depths(root, "receiver_depth_m");
  const bool around_source = centre == Centre::kSource;
  const std::vector<double>& middle = around_source ? source_m : receiver_m;
  if (middle.size() > 1) {
    root.problem(around_source ? "source_depth_m" : "receiver_depth_m",
                 "must be one depth, that of what stands in the centre; with centre = \"hydrophone\" sources may have many, "
                 "with \"source\" receivers");
  }
  if (middle.empty()) return;
  radial.source_depth = Meters{middle.front()};
  radial.depth_m = around_source ? receiver_m : source_m;
}

void read_radials(TableReader table, sonar::FanPlan& fan) {
  fan.bearings = static_cast<std::size_t>(table.integer("count", 1, 100'000));
  const double max_range_m = 1000.0 * table.number("max_range_km", Range::between(0.001, 2000.0));
  fan.radial.range_step = Meters{table.number("range_step_m", Range::between(0.01, 100'000.0))};
  fan.radial.options.accuracy = Decibels{table.number_or("accuracy_db", 0.1, Range::between(0.0001, 10.0))};
  fan.radial.ranges = static_cast<std::size_t>(std::max(1.0, std::floor(max_range_m / fan.radial.range_step.value + 1e-9)));
  const double values =
      static_cast<double>(fan.bearings) * static_cast<double>(fan.radial.ranges) * static_cast<double>(fan.radial.depth_m.size());
  if (values > sonar::kMostFanValues)
    table.problem("range_step_m", "radials x ranges x depths of one position must not exceed 64 million values");
}

std::optional<ocean::Band> read_band(TableReader table) {
  const ocean::Band band{.low = Hertz{table.number("low_hz", Range::between(1.0, 10'000.0))},
                         .high = Hertz{table.number("high_hz", Range::between(1.0, 10'000.0))},
                         .count = static_cast<std::size_t>(table.integer("frequencies", 1, kMostFrequencies))};
  if (!(band.low < band.high)) table.problem("high_hz", "must be more than low_hz");
  return band;
}

/// Charts tell only at each position whether a depth has water; without them the sea floor is the same about all.
void require_depths_in_water(const std::filesystem::path& path, const LibraryPlan& plan) {
  if (sonar::differs_with_place(plan.environment)) return;
  const sonar::RadialPlan& radial = plan.fan.radial;
  const ocean::Section section = ocean::section_along(plan.environment, {}, Radians{}, radial.max_range());
  const double floor_m = sonar::deepest_sea_floor(section, radial.max_range()).value;
  if (radial.depth_m.back() <= floor_m) return;
  std::ostringstream text;
  text << path.string() << ": " << (plan.centre == Centre::kSource ? "receiver_depth_m" : "source_depth_m") << " = "
       << radial.depth_m.back() << ": must not exceed the depth of the sea floor, " << floor_m << " m";
  throw host::BadInput(text.str());
}

constexpr std::size_t kBearingsSampled = 8;

bool is_in_water(const LibraryPlan& plan, NorthEast position) {
  Meters floor = plan.environment.seabed.depth;
  if (plan.environment.charts != nullptr && plan.environment.charts->bathymetry) {
    const ocean::Charts& charts = *plan.environment.charts;
    floor = ocean::sea_floor_depth(*charts.bathymetry, charts.grid.to_geographic(position));
  }
  return plan.fan.radial.source_depth < floor;
}

void require_on_chart(const LibraryPlan& plan, NorthEast position) {
  const Meters max_range = plan.fan.radial.max_range();
  const std::size_t stride = std::max<std::size_t>(1, plan.fan.bearings / kBearingsSampled);
  for (std::size_t j = 0; j < plan.fan.bearings; j += stride)
    (void)ocean::section_along(plan.environment, position, sonar::bearing_of(j, plan.fan.bearings), max_range);
}

}  // namespace

LibraryPlan load_library_plan(const std::filesystem::path& path, const EnvironmentReader& read_environment) {
  const host::TomlFile file(path);
  TableReader root = file.root();
  LibraryPlan plan{
      .name = root.text("name"),
      .environment = {},
      .positions = read_positions(root.table("positions")),
      .centre = static_cast<Centre>(root.choice_or("centre", 0, {"source", "hydrophone"})),
      .fan = {.bearings = 1, .radial = {.source_depth = {}, .depth_m = {}, .range_step = Meters{1.0}, .ranges = 1, .band = {}}},
      .file_crc32 = host::crc32_of_file(path)};
  const std::filesystem::path environment = file.resolve(root.text("environment"));
  read_all_depths(root, plan.centre, plan.fan.radial);
  read_radials(root.table("radials"), plan.fan);
  std::optional<ocean::Band> band;
  if (const auto table = root.optional_table("band")) band = read_band(*table);
  file.finish();
  plan.environment = read_environment(environment);
  const Hertz frequency = plan.environment.source.frequency;
  plan.fan.radial.band = band.value_or(ocean::Band{frequency, frequency});
  require_depths_in_water(path, plan);
  return plan;
}

std::vector<bool> positions_in_water(const LibraryPlan& plan) {
  std::vector<bool> in_water;
  for (const NorthEast& position : plan.positions) {
    in_water.push_back(is_in_water(plan, position));
    if (in_water.back() && sonar::differs_with_place(plan.environment)) require_on_chart(plan, position);
  }
  if (std::ranges::find(in_water, true) == in_water.end())
    throw host::BadInput(plan.name + ": every position is on land or too shallow for the depth in its centre");
  return in_water;
}

std::optional<ocean::UnmeasuredWater> unmeasured_water(const LibraryPlan& plan) {
  std::optional<ocean::UnmeasuredWater> thickest;
  if (!sonar::differs_with_place(plan.environment) || !plan.environment.charts->climatology) return thickest;
  for (const NorthEast& position : plan.positions) {
    if (!is_in_water(plan, position)) continue;
    const auto here = sonar::unmeasured_water(plan.environment, position, kBearingsSampled, plan.fan.radial.max_range());
    if (here && (!thickest || here->thickness() > thickest->thickness())) thickest = here;
  }
  return thickest;
}

}  // namespace earshot::field_library
