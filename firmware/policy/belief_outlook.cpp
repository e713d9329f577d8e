#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/policy/belief.hpp"

namespace earshot::policy {

void Belief::summarise(const BeliefModel& model) {
  const std::size_t rows = model.cells_north, columns = model.cells_east;
  const double size_north = model.area_size.north.value / double(rows), size_east = model.area_size.east.value / double(columns);
  double north = 0, east = 0, n2 = 0, e2 = 0, total = 0, squares = 0;
  std::size_t best = 0;
  for (std::size_t n = 0; n < rows; ++n) {
    double row = 0, re = 0, re2 = 0;
    for (std::size_t e = 0; e < columns; ++e) {
      const std::size_t i = n * columns + e;
      const double m = double{marginal_[i]};
      if (marginal_[i] > marginal_[best]) best = i;
      row += m; re += m * double(e); re2 += m * double(e) * double(e); squares += m * m;
    }
    total += row; north += row * double(n); n2 += row * double(n) * double(n); east += re; e2 += re2;
  }
  north /= total; east /= total; n2 /= total; e2 /= total;
  summary_.likeliest = {Meters{(double(best / columns) + 0.5) * size_north}, Meters{(double(best % columns) + 0.5) * size_east}};
  summary_.mean = {Meters{(north + 0.5) * size_north}, Meters{(east + 0.5) * size_east}};
  summary_.spread = Meters{sqrt((n2 - north * north) * size_north * size_north + (e2 - east * east) * size_east * size_east)};
  summary_.likeliest_share = marginal_[best];
  summary_.effective_cells = static_cast<float>(1.0 / squares);
}

void Belief::look_out(const BeliefModel&, NorthEast) {}

}  // namespace earshot::policy
