#include "sim/pe/starter.hpp"

#include <cmath>
#include <numbers>

namespace earshot::pe {

namespace {

void add_delta(std::vector<double>& u, const DepthGrid& grid, const StartingSource& source) {
  const DepthTap tap = tap_at(grid, source.depth_m, source.floor_depth_m);
  for (std::size_t k = 0; k < DepthTap::kNodes; ++k) u[tap.node[k]] += tap.weight[k] / grid.step_m;
}

void add_gaussian(std::vector<double>& u, const DepthGrid& grid, const StartingSource& source) {
  const double k = source.wavenumber_per_m;
  const auto bell = [k](double z) { return k / std::sqrt(2.0 * std::numbers::pi) * std::exp(-0.5 * (k * z) * (k * z)); };
  for (std::size_t node = 0; node < u.size(); ++node) {
    const double z = static_cast<double>(node) * grid.step_m;
    u[node] += bell(z - source.depth_m) - bell(z + source.depth_m);
  }
}

}  // namespace

std::vector<double> make_starter(Starter starter, const DepthGrid& grid, const StartingSource& source) {
  std::vector<double> u(grid.intervals + 1, 0.0);
  if (starter == Starter::kSelf) add_delta(u, grid, source);
  if (starter == Starter::kGaussian) add_gaussian(u, grid, source);
  u.front() = 0.0;
  u.back() = 0.0;
  return u;
}

}  // namespace earshot::pe
