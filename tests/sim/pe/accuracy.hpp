#pragma once

#include <algorithm>
#include <cmath>

#include "sim/pe/grid_choice.hpp"
#include "sim/pe/solver.hpp"
#include "tests/sim/pe/oceans.hpp"

namespace earshot::pe::tests {

/// Rows of the field: a thousand, or one a sixth of a wavelength if that is longer.
inline double row_m(const Ocean& ocean) {
  return std::max(ocean.max_range_m / 1000.0, 250.0 / ocean.frequency_hz);
}

inline Field solve_with(const Ocean& ocean, const Options& options) {
  return solve(section_of(ocean.section), {Hertz{ocean.frequency_hz}, Meters{ocean.source_depth_m}}, options, ocean.receiver_depth_m,
               Meters{ocean.max_range_m});
}

/// On a grid of one's own; the range step is shortened until steps and rows divide each other.
inline Field solve_on(const Ocean& ocean, double depth_step_m, double range_step_m, std::size_t terms) {
  const double row = row_m(ocean);
  const double step = range_step_m >= row ? row * std::floor(range_step_m / row + 1e-9) : row / std::ceil(row / range_step_m - 1e-9);
  return solve_with(ocean, {.depth_step = Meters{depth_step_m}, .range_step = Meters{step}, .terms = terms, .output_step = Meters{row}});
}

inline GridChoice automatic_grid(const Ocean& ocean, Decibels accuracy) {
  return choose_grid(section_of(ocean.section), Hertz{ocean.frequency_hz}, Meters{ocean.max_range_m}, accuracy);
}

inline Field solve_automatically(const Ocean& ocean, Decibels accuracy) {
  return solve_with(ocean, {.output_step = Meters{row_m(ocean)}, .accuracy = accuracy});
}

/// Mean |difference| of transmission loss from 1/25 of the range on, without points more than 10 dB below the local power mean (1/25 of the
/// range either way), as tolerance_db of the reference cases.
inline double mean_difference_db(const Field& field, const Field& truth) {
  const Eigen::Index rows = truth.pressure.rows();
  const Eigen::Index window = std::max<Eigen::Index>(3, rows / 25);
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index column = 0; column < truth.pressure.cols(); ++column) {
    for (Eigen::Index row = rows / 25; row < rows; ++row) {
      const Eigen::Index first = std::max<Eigen::Index>(0, row - window);
      const Eigen::Index last = std::min(rows - 1, row + window);
      const double local = truth.pressure.col(column).segment(first, last - first + 1).abs2().mean();
      const double there = std::norm(truth.pressure(row, column));
      if (there < 0.1 * local) continue;
      sum += std::abs(10.0 * std::log10(std::norm(field.pressure(row, column)) / there));
      ++count;
    }
  }
  return sum / std::max(1, count);
}

}  // namespace earshot::pe::tests
