#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/ocean/section.hpp"
#include "sim/pe/depth_grid.hpp"
#include "sim/pe/sediment_points.hpp"

namespace earshot::pe {

/// A symmetric tridiagonal matrix over the nodes of a depth grid: off[i] couples nodes i and i + 1.
struct Tridiagonal {
  std::vector<std::complex<double>> diagonal, off;
};

/// Rows first to last, both inclusive; none when last < first.
struct RowRange {
  std::size_t first = 1;
  std::size_t last = 0;
  [[nodiscard]] bool empty() const { return last < first; }
};

/// The depth operator of the parabolic equation at one range, as a pencil of symmetric tridiagonal matrices: X = M^-1 G.
///
///   X = k0^-2 (rho d/dz rho^-1 d/dz + k^2) - 1
///
/// Every element carries its own medium. The mass weights are Numerov's (5/12, 1/12 of an element's length), and its density is
/// scaled by 1 - (k^2 - k0^2) h^2 / 12: with both, elements of one length agree with the exact two-point solution to fourth order up to a
/// factor that is the same in all media, 1 + (k0 h)^2 X / 12. In an element that an interface divides, the pressure is linear on each side
/// and the flux continuous, so that an interface may lie, and move, anywhere between nodes. An element of the absorber is the same one for
/// another, complex length l: mass l / 4 (1 1; 1 1) + h^2 / 6 l (1 -1; -1 1), which is Numerov's where l = h.
/// Source: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics, 2nd ed., ch. 6; the element by hand from its exact dynamic
///   stiffness (k cot kh, -k / sin kh).   Oracle: DepthOperator.*
class DepthOperator {
 public:
  DepthOperator(const ocean::Section& section, Hertz frequency, const DepthGrid& grid);

  /// Rows that differ between here and another range.
  [[nodiscard]] RowRange rows_changed_by(double range_m) const;
  void move_to(double range_m);

  [[nodiscard]] const Tridiagonal& mass() const { return mass_; }
  [[nodiscard]] const Tridiagonal& g() const { return g_; }
  [[nodiscard]] double floor_depth_m() const { return floor_depth_m_; }
  [[nodiscard]] const DepthGrid& grid() const { return grid_; }
  /// Here, from the sea floor down.
  [[nodiscard]] std::span<const Interface> interfaces() const { return interfaces_; }

 private:
  using Complex = std::complex<double>;
  struct Element {
    Complex stiffness;  // K = stiffness (1 -1; -1 1)
    Complex mass00, mass01, mass11;
    Complex potential00, potential01, potential11;  // of (k^2 - k0^2) / k0^2
  };
  /// One medium between two depths within an element.
  struct Slice {
    Complex potential_top, potential_bottom;
    double length_m;
    double density;
  };
  [[nodiscard]] Element uniform(const Slice& slice) const;
  [[nodiscard]] static Element galerkin(const Slice& slice);
  [[nodiscard]] static Element joined(const Element& upper, const Element& lower);
  [[nodiscard]] Element with_numerov_mass(Element element) const;
  template <class Visitor>
  void visit_slices(double top_m, double bottom_m, const Visitor& visit) const;
  [[nodiscard]] Element element(std::size_t index) const;
  [[nodiscard]] Element absorber_element(std::size_t index) const;
  [[nodiscard]] Complex potential_of(const SedimentPoint& point) const;
  [[nodiscard]] Complex water_potential(double depth_m) const;
  void find_interfaces();
  void sample_water(double range_m);
  void assemble(std::size_t first_element, std::size_t last_element);
  [[nodiscard]] double floor_at(double range_m) const;
  [[nodiscard]] const std::vector<SedimentPoint>& sediment_at(double range_m) const;
  [[nodiscard]] bool water_varies() const { return section_.water.size() > 1; }
  [[nodiscard]] std::size_t element_of(double depth_m) const;

  const ocean::Section section_;
  double angular_frequency_;
  DepthGrid grid_;
  double range_m_ = 0.0;
  double floor_depth_m_ = 0.0;
  std::vector<std::vector<SedimentPoint>> sediment_of_;   // [sediment station]
  const std::vector<SedimentPoint>* sediment_ = nullptr;  // the one here
  std::vector<std::vector<double>> sound_speed_;          // [water column][node]
  std::vector<Complex> water_potential_;                  // [node]
  std::vector<Interface> interfaces_;
  Tridiagonal mass_, g_;
};

}  // namespace earshot::pe
