#include "sim/pe/starter.hpp"

#include <cmath>
#include <numbers>

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;
using Nodes = std::vector<Complex>;

/// Without the first and the last node, where there is no pressure.
Nodes product(const Tridiagonal& matrix, const Nodes& u) {
  Nodes result(u.size());
  for (std::size_t i = 1; i + 1 < u.size(); ++i)
    result[i] = matrix.off[i - 1] * u[i - 1] + matrix.diagonal[i] * u[i] + matrix.off[i] * u[i + 1];
  return result;
}

/// Thomas elimination.
Nodes solution(const Tridiagonal& matrix, Nodes right) {
  const std::size_t last = right.size() - 2;
  Nodes pivot(right.size());
  right.front() = right.back() = 0.0;
  for (std::size_t i = 1; i <= last; ++i) {
    const Complex multiplier = i > 1 ? matrix.off[i - 1] / pivot[i - 1] : 0.0;
    pivot[i] = matrix.diagonal[i] - multiplier * matrix.off[i - 1];
    right[i] -= multiplier * right[i - 1];
  }
  for (std::size_t i = last; i >= 1; --i) right[i] = (right[i] - matrix.off[i] * right[i + 1]) / pivot[i];
  return right;
}

Nodes delta(const DepthOperator& depth_operator, double depth_m) {
  const DepthGrid& grid = depth_operator.grid();
  Nodes weights(grid.intervals + 1);
  const DepthTap tap = tap_at(grid, depth_m, depth_operator.interfaces());
  for (std::size_t k = 0; k < tap.count; ++k) weights[tap.node[k]] += tap.weight[k];
  Nodes u = solution(depth_operator.mass(), weights);
  const Nodes more = solution(depth_operator.mass(), product(depth_operator.g(), u));
  const double phase = grid.reference_wavenumber_per_m * grid.step_m;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += phase * phase / 12.0 * more[i];
  return u;
}

Nodes gaussian(const DepthGrid& grid, const StartingSource& source) {
  const double k = source.wavenumber_per_m;
  const auto bell = [k](double z) { return k / std::sqrt(2.0 * std::numbers::pi) * std::exp(-0.5 * (k * z) * (k * z)); };
  Nodes u(grid.intervals + 1);
  for (std::size_t node = 1; node < grid.absorber_node(); ++node) {
    const double z = static_cast<double>(node) * grid.step_m;
    u[node] = bell(z - source.depth_m) - bell(z + source.depth_m);
  }
  return u;
}

}  // namespace

std::vector<Complex> make_starter(Starter starter, const DepthOperator& depth_operator, const StartingSource& source) {
  return starter == Starter::kSelf ? delta(depth_operator, source.depth_m) : gaussian(depth_operator.grid(), source);
}

}  // namespace earshot::pe
