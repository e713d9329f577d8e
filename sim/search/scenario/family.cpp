#include "sim/search/scenario/family.hpp"

#include <limits>
#include <variant>

#include "firmware/core/random.hpp"

namespace earshot::search {
namespace {

using host::Range;
using host::TableReader;

std::optional<Bounds> read_bounds(TableReader& table, std::string_view key, Range range) {
  if (!table.has(key)) return std::nullopt;
  const std::vector<double> values = table.numbers(key, range);
  if (table.is_noted(key)) return std::nullopt;
  if (values.size() == 2 && values[0] <= values[1]) return Bounds{values[0], values[1]};
  table.problem(key, "must be [lowest, highest]");
  return std::nullopt;
}

/// Takes a number from `random` whether or not there are bounds, so that a bound more does not change what the others draw.
double drawn(const std::optional<Bounds>& bounds, double own, Pcg32& random) {
  const double fraction = random.uniform_double();
  return bounds ? bounds->lowest + fraction * (bounds->highest - bounds->lowest) : own;
}

}  // namespace

Family read_family(TableReader table) {
  return {.members = static_cast<std::size_t>(table.integer("members", 1, 1'000)),
          .seed = static_cast<std::uint64_t>(table.integer_or("seed", 1, 0, std::numeric_limits<std::int64_t>::max())),
          .sea_floor_depth_m = read_bounds(table, "sea_floor_depth_m", Range::above_up_to(0.0, 12'000.0)),
          .axis_depth_m = read_bounds(table, "axis_depth_m", Range::above_up_to(0.0, 12'000.0)),
          .perturbation = read_bounds(table, "perturbation", Range::between(0.0, 0.1)),
          .sediment_sound_speed_mps = read_bounds(table, "sediment_sound_speed_mps", Range::between(1'000.0, 8'000.0)),
          .noise_level_db_re_1upa = read_bounds(table, "noise_level_db_re_1upa", Range::between(-100.0, 300.0))};
}

std::vector<ocean::Environment> draw_family(const ocean::Environment& own, const Family& family) {
  std::vector<ocean::Environment> members;
  Pcg32 random(family.seed);
  for (std::size_t i = 0; i < family.members; ++i) {
    ocean::Environment member = own;
    auto& munk = std::get<ocean::MunkProfile>(member.water);
    auto& sediment = member.seabed.layers.back();
    const double scale_by_axis = munk.scale / munk.axis_depth;
    member.seabed.depth = Meters{drawn(family.sea_floor_depth_m, member.seabed.depth.value, random)};
    munk.axis_depth = Meters{drawn(family.axis_depth_m, munk.axis_depth.value, random)};
    munk.scale = scale_by_axis * munk.axis_depth;
    munk.perturbation = drawn(family.perturbation, munk.perturbation, random);
    sediment.sound_speed = MetersPerSecond{drawn(family.sediment_sound_speed_mps, sediment.sound_speed.value, random)};
    member.noise_level = Decibels{drawn(family.noise_level_db_re_1upa, member.noise_level.value, random)};
    members.push_back(std::move(member));
  }
  return members;
}

}  // namespace earshot::search
