#include "firmware/policy/tables/ocean_tables.hpp"

#include <algorithm>

#include "firmware/policy/belief/search_bounds.hpp"

namespace earshot::policy {
namespace {

/// An area's corners far from the origin are rounded, and its diagonal with them.
constexpr Meters kReachTolerance{0.01};

bool is_depth(double depth_m) {
  return depth_m > 0.0 && depth_m <= kMostDepth_m;
}

bool is_range(DepthRange depths) {
  return is_depth(depths.least.value) && is_depth(depths.most.value) && depths.least <= depths.most;
}

bool is_within_share(double value, double of, double share) {
  return is_within(value, (1.0 - share) * of, (1.0 + share) * of);
}

}  // namespace

std::int8_t to_half_db(double snr_db) {
  if (!(snr_db > double{kLeastTableSnr_db})) return -128;
  if (snr_db >= double{kMostTableSnr_db}) return 127;
  // A cast rounds towards zero: counted from the fainter end, that is down.
  const auto above_least = static_cast<int>((snr_db - double{kLeastTableSnr_db}) / double{kHalfDecibel} + 0.5);
  return static_cast<std::int8_t>(above_least - 128);
}

bool has_valid_shape(const OceanTables& tables) {
  return tables.range_count >= 1 && tables.range_count <= config::kMaxTableRanges && !tables.tables.empty() &&
         std::all_of(tables.tables.begin(), tables.tables.end(), [](const OceanTable& table) { return !table.name.empty(); });
}

bool has_valid_grid(const OceanTables& tables) {
  return is_within(tables.frequency.value, kLeastFrequency_hz, kMostFrequency_hz) && is_depth(tables.receiver_depth.value) &&
         is_range(tables.source_depth) && is_range(tables.sea_depth) &&
         is_within(tables.range_step.value, kLeastLength_m, kMostRangeStep_m);
}

bool has_valid_numbers(const OceanTables& tables) {
  const auto is_valid = [&tables](const OceanTable& table) {
    return is_within(double{table.prior}, kLeastPrior, kMostPrior) &&
           is_within(double{table.sea_depth_m}, tables.sea_depth.least.value, tables.sea_depth.most.value);
  };
  return has_valid_grid(tables) && std::all_of(tables.tables.begin(), tables.tables.end(), is_valid);
}

Coverage coverage(const OceanTables& tables, const SearchedSound& sound) {
  if (!is_within_share(sound.vehicle_depth.value, tables.receiver_depth.value, kDepthTolerance)) return Coverage::kAnotherDepth;
  if (!is_within_share(sound.frequency.value, tables.frequency.value, kFrequencyTolerance)) return Coverage::kAnotherFrequency;
  return sound.furthest <= reach(tables) + kReachTolerance ? Coverage::kCovered : Coverage::kOutOfReach;
}

bool are_usable(const OceanTables& tables, const SearchedSound& sound) {
  return has_valid_shape(tables) && has_valid_numbers(tables) && coverage(tables, sound) == Coverage::kCovered;
}

}  // namespace earshot::policy
