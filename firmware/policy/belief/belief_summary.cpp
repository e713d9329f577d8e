#include "firmware/policy/belief/belief_summary.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"

namespace earshot::policy {

EARSHOT_WIDE messages::BeliefSummary summary_of(const BeliefModel& model, std::span<const float> probabilities) {
  const std::size_t rows = model.cells_north;
  const std::size_t columns = model.cells_east;
  double all = 0.0;
  std::array<double, 2> north{};  // first and second moment of the place, in cells, that many times
  std::array<double, 2> east{};
  double squares = 0.0;
  std::size_t best = 0;
  float most = probabilities[0];
  for (std::size_t n = 0; n < rows; ++n) {
    float row = 0.0F;
    float row_east = 0.0F;
    float row_east_squared = 0.0F;
    float row_squares = 0.0F;
    float column = 0.0F;
    float most_of_row = most;
#pragma GCC unroll 4
    for (const float p : probabilities.subspan(n * columns, columns)) {
      row += p;
      row_east += p * column;
      row_east_squared += p * column * column;
      row_squares += p * p;
      most_of_row = greater(most_of_row, p);
      column += 1.0F;
    }
    if (most_of_row > most) {
      most = most_of_row;
      best = n * columns;
      while (probabilities[best] < most) ++best;
    }
    const auto place = static_cast<double>(n);
    const auto share = static_cast<double>(row);
    all += share;
    north = {north[0] + share * place, north[1] + share * place * place};
    east = {east[0] + double{row_east}, east[1] + double{row_east_squared}};
    squares += double{row_squares};
  }
  const Meters size_north = model.area_size.north / static_cast<double>(rows);
  const Meters size_east = model.area_size.east / static_cast<double>(columns);
  const double mean_north = north[0] / all;
  const double mean_east = east[0] / all;
  const double variance_north = std::max(0.0, north[1] / all - mean_north * mean_north);
  const double variance_east = std::max(0.0, east[1] / all - mean_east * mean_east);
  messages::BeliefSummary summary;
  summary.likeliest = {(static_cast<double>(best / columns) + 0.5) * size_north, (static_cast<double>(best % columns) + 0.5) * size_east};
  summary.mean = {(mean_north + 0.5) * size_north, (mean_east + 0.5) * size_east};
  summary.spread = length_of({sqrt(variance_north) * size_north, sqrt(variance_east) * size_east});
  summary.likeliest_share = probabilities[best];
  summary.effective_cells = static_cast<float>(1.0 / squares);
  return summary;
}

}  // namespace earshot::policy
