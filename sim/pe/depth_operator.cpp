#include "sim/pe/depth_operator.hpp"

namespace earshot::pe {
namespace {

struct Row {
  std::complex<double> lower, diagonal, upper;
};

Row stiffness(const Element& above, const Element& below) {
  const std::complex<double> up = 1.0 / (above.density_g_per_cm3 * above.length_m);
  const std::complex<double> down = 1.0 / (below.density_g_per_cm3 * below.length_m);
  return {-up, up + down, -down};
}

/// Mass of the node between two elements; each medium's share carries that medium's own factor at the node it multiplies.
struct MassRow {
  Row plain;       ///< M
  Row wavenumber;  ///< M k^2
};

MassRow mass(const Element& above, const Element& below) {
  const bool inside = above.medium == below.medium;
  const double near = inside ? 5.0 / 12.0 : 1.0 / 3.0;
  const double far = inside ? 1.0 / 12.0 : 1.0 / 6.0;
  const std::complex<double> up = above.length_m / above.density_g_per_cm3;
  const std::complex<double> down = below.length_m / below.density_g_per_cm3;
  return {.plain = {far * up, near * (up + down), far * down},
          .wavenumber = {far * up * above.squared_wavenumber_top,
                         near * (up * above.squared_wavenumber_bottom + down * below.squared_wavenumber_top),
                         far * down * below.squared_wavenumber_bottom}};
}

void append(Tridiagonal& matrix, const Row& row) {
  matrix.lower.push_back(row.lower);
  matrix.diagonal.push_back(row.diagonal);
  matrix.upper.push_back(row.upper);
}

}  // namespace

DepthOperator make_depth_operator(const DepthGrid& grid, double reference_wavenumber_per_m) {
  const double scale = 1.0 / (reference_wavenumber_per_m * reference_wavenumber_per_m);
  DepthOperator result;
  for (std::size_t i = 1; i < grid.elements.size(); ++i) {
    const Row k = stiffness(grid.elements[i - 1], grid.elements[i]);
    const MassRow m = mass(grid.elements[i - 1], grid.elements[i]);
    append(result.mass, m.plain);
    append(result.g, {.lower = scale * (m.wavenumber.lower - k.lower) - m.plain.lower,
                      .diagonal = scale * (m.wavenumber.diagonal - k.diagonal) - m.plain.diagonal,
                      .upper = scale * (m.wavenumber.upper - k.upper) - m.plain.upper});
  }
  result.mass.lower.front() = result.g.lower.front() = 0.0;  // the surface and the end of the absorber hold no pressure
  result.mass.upper.back() = result.g.upper.back() = 0.0;
  return result;
}

}  // namespace earshot::pe
