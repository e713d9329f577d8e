#include "sim/search/scenario/conditions_table.hpp"

#include <cstdint>
#include <numbers>
#include <optional>

namespace earshot::search {
namespace {

using host::Range;
using host::TableReader;

constexpr double kMostDecibels = 100.0;  // more than any sound in the sea differs from another
constexpr double kFastest_mps = 20.0;    // of anything that swims
constexpr double kSlowest_mps = 0.01;    // of a vehicle: slower, a kilometre takes more than a day
constexpr double kLeastSeconds = 0.01;   // shorter than any call
constexpr double kMostSeconds = 1.0e6;   // eleven days: a search lasts half a day

Current read_current(TableReader table) {
  Current current{.speed = MetersPerSecond{table.number("speed_mps", Range::between(0.0, kFastest_mps))}, .toward = {}};
  if (table.has("toward_deg")) {
    current.toward = Radians{table.number("toward_deg", Range::between(0.0, 360.0)) * std::numbers::pi / 180.0};
  }
  current.navigation = table.boolean_or("seen_by_navigation", true) ? Current::Navigation::kSeesIt : Current::Navigation::kDoesNotSeeIt;
  return current;
}

CallPattern read_calls(TableReader table) {
  return {.interval_s = table.number("interval_s", Range::between(kLeastSeconds, kMostSeconds)),
          .song_s = table.number("song_s", Range::between(kLeastSeconds, kMostSeconds)),
          .pause_s = table.number("pause_s", Range::between(0.0, kMostSeconds)),
          .listening_s = table.number("listening_s", Range::between(kLeastSeconds, kMostSeconds))};
}

std::optional<BearingConditions> read_bearing(TableReader& table) {
  const bool is_ambiguous = table.boolean_or("bearing_ambiguous", false);
  if (!table.has("bearing_deg")) {
    if (table.has("bearing_ambiguous")) table.problem("bearing_ambiguous", "of use only with bearing_deg, how far a bearing is off");
    return std::nullopt;
  }
  constexpr double kLeast_deg = 0.01;  // a thousandth of what any array measures
  return BearingConditions{.deviation = Radians{table.number("bearing_deg", Range::between(kLeast_deg, 180.0)) * std::numbers::pi / 180.0},
                           .is_ambiguous = is_ambiguous};
}

SoundConditions read_sound(TableReader table) {
  SoundConditions sound;
  sound.lost_blocks = table.number_or("lost_blocks", sound.lost_blocks, Range::between(0.0, 1.0));
  sound.self_noise = Decibels{table.number_or("self_noise_db_re_1upa_at_2mps", sound.self_noise.value, Range::between(-100.0, 300.0))};
  return sound;
}

}  // namespace

Conditions read_conditions(TableReader table) {
  Conditions c;
  c.fluctuation = Decibels{table.number_or("fluctuation_db", 0.0, Range::between(0.0, kMostDecibels))};
  if (table.has("least_fluctuation_db"))
    c.least_fluctuation = Decibels{table.number("least_fluctuation_db", Range::between(0.0, c.fluctuation.value))};
  if (table.has("floor_db")) c.floor = Decibels{table.number("floor_db", Range::between(-kMostDecibels, kMostDecibels))};
  c.source_level_spread = Decibels{table.number_or("source_level_spread_db", 0.0, Range::between(0.0, kMostDecibels))};
  c.drift_m_per_sqrt_km = table.number_or("navigation_drift_m_per_sqrt_km", 0.0, Range::between(0.0, 10'000.0));
  c.source_speed = MetersPerSecond{table.number_or("source_speed_mps", 0.0, Range::between(0.0, kFastest_mps))};
  c.sources = static_cast<std::size_t>(table.integer_or("sources", 1, 1, static_cast<std::int64_t>(kMaxSources)));
  c.vehicle_speed =
      MetersPerSecond{table.number_or("vehicle_speed_mps", c.vehicle_speed.value, Range::between(kSlowest_mps, kFastest_mps))};
  c.bearing = read_bearing(table);
  if (const auto current = table.optional_table("current")) c.current = read_current(*current);
  if (const auto calls = table.optional_table("calls")) c.calls = read_calls(*calls);
  if (const auto sound = table.optional_table("sound")) c.sound = read_sound(*sound);
  if (c.calls && !table.has("floor_db")) {
    table.problem("calls",
                  "need floor_db, the least SNR that can be measured: all that is known of an SNR measurement that is too faint is that it "
                  "was below");
  }
  return c;
}

}  // namespace earshot::search
