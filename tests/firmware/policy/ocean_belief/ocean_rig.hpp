#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {

/// Oceans of ranges every 100 m; none of them yet.
inline OceanTables no_tables(std::uint16_t range_count) {
  OceanTables tables;
  tables.range_step = Meters{100};
  tables.range_count = range_count;
  return tables;
}

/// One more ocean. @param snr_db  of a range in km; half decibels are kept
template <class Snr>
void add_table(OceanTables& tables, float prior, Snr snr_db) {
  OceanTable table;
  table.prior = prior;
  for (std::size_t i = 0; i < tables.range_count; ++i) table.snr_half_db[i] = to_half_db(snr_db(static_cast<double>(i) * 0.1));
  EXPECT_EQ(tables.tables.push_back(table), Status::kOk);
}

/// 10 km x 10 km in cells of 500 m, four actions, and 2 % of outliers.
inline BeliefModel small_model() {
  BeliefModel model = bare_model(at(10'000, 10'000), 20, 20);
  model.outlier_share = 0.02F;
  return model;
}

/// In 10 km x 10 km and 2 km about it, from where nothing is ruled out.
inline constexpr std::uint16_t kSmallRanges = 180;

inline double clamped(double x, double least, double most) {
  return std::min(std::max(x, least), most);
}

/// Likelihood of what was received, were the source at a range, written out: the normal distribution, pauses, outliers over 80 dB, and the
/// mean over a cell.
inline std::vector<double> likelihoods_by_hand(const BeliefModel& model, const OceanTables& tables, const Hypothesis& h,
                                               Reception reception) {
  const std::vector<double> offsets{-9, -6, -3, 0, 3, 6, 9};
  const std::vector<double> spreads{1, 2, 4, 7};
  const std::vector<double> silences{0, 0.25, 0.5, 0.75};
  const double sigma = spreads[h.spread];
  const double silent = silences[h.silence];
  const auto outlier = static_cast<double>(model.outlier_share);
  const double cell = std::max(model.area_size.north.value / model.cells_north, model.area_size.east.value / model.cells_east);
  const double step = tables.range_step.value;
  const int last = tables.range_count - 1;
  std::vector<double> at_range;
  for (int i = 0; i <= last; ++i) {
    const double expected = 0.5 * tables.tables[h.table].snr_half_db[static_cast<std::size_t>(i)] + offsets[h.level];
    const double z = (reception.snr.value - expected) / sigma;
    const double density = std::exp(-0.5 * z * z) / (sigma * std::sqrt(2.0 * std::numbers::pi));
    const double below = 0.5 * std::erfc(-z / std::sqrt(2.0));
    at_range.push_back(!reception.too_faint ? (1.0 - silent) * ((1.0 - outlier) * density + outlier / 80.0)
                                            : silent + (1.0 - silent) * ((1.0 - outlier) * below + outlier * 0.5));
  }
  const int half = std::min(static_cast<int>(0.5 * cell / step), last);
  std::vector<double> result;
  for (int i = 0; i <= last; ++i) {
    double sum = 0.0;
    for (int k = i - half; k <= i + half; ++k) sum += at_range[static_cast<std::size_t>(std::clamp(k, 0, last))];
    result.push_back(std::pow(sum / (2 * half + 1), 0.8125));  // 208 / 256 of a measurement's logarithm counts
  }
  return result;
}

/// Share of a cell, its centre at a range step, that lies further away than a step of the search: what is left of it after a declaration.
inline double left_of_cell(const BeliefModel& model, const OceanTables& tables, std::size_t range) {
  const double range_m = static_cast<double>(range) * tables.range_step.value;
  const double cell_m = model.area_size.north.value / model.cells_north;
  return clamped((range_m - model.step_length.value) / cell_m + 0.5, 1e-3, 1.0);
}

/// Range step at which a cell's centre lies, the nearest.
inline std::size_t range_of(const BeliefModel& model, const OceanTables& tables, NorthEast position, std::size_t cell) {
  const NorthEast middle = at((static_cast<double>(cell / model.cells_east) + 0.5) * model.area_size.north.value / model.cells_north,
                              (static_cast<double>(cell % model.cells_east) + 0.5) * model.area_size.east.value / model.cells_east);
  const double steps = range_between(position, middle) / tables.range_step;
  return static_cast<std::size_t>(std::min(std::lround(steps), long{tables.range_count - 1}));
}

}  // namespace earshot::policy
