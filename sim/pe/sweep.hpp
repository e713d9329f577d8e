#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/pe/depth_operator.hpp"
#include "sim/pe/rational/rational.hpp"

namespace earshot::pe {

/// One range step, u <- R(X) u, without allocating.
///
///   R(X) u = sum_j y_j,   y_j = residue_j (M - G / pole_j)^-1 M u
///
/// All poles are eliminated together, one to a vector lane, over the one right-hand side M u. The elimination runs from both ends to a
/// meeting row; where the medium changes with range only factors between the changed rows and the meeting row are computed anew.
///
/// Where the medium changes, the right-hand side is half of M before and half of M after: the mean of continuous pressure and continuous
/// velocity, which is the coupled-mode matching of a staircase step to first order, and unlike a conserved norm does not count the
/// evanescent waves of the step's corner as energy.
/// Source: Evans, J. Acoust. Soc. Am. 74 (1983) 188 (matching); Thomas elimination.   Oracle: Sweep.SolvesWhatADenseEliminationSolves
class Sweep {
 public:
  static constexpr std::size_t kMaxTerms = 16;

  /// @param terms  1 to kMaxTerms; a multiple of four fills the vector lanes
  Sweep(std::size_t intervals, std::size_t terms);

  void set_field(std::size_t node, std::complex<double> u) { re_[node] = u.real(), im_[node] = u.imag(); }
  [[nodiscard]] std::complex<double> field(std::size_t node) const { return {re_[node], im_[node]}; }

  /// A new rational function of the same number of terms: every factor is out of date until `take`.
  void set_rational(const Rational& rational);

  /// Takes over the medium of `depth_operator`, of which only `changed` rows differ from the last time, and factorises.
  /// @param meeting_row  where the eliminations meet: best at the rows that change most often
  void take(const DepthOperator& depth_operator, RowRange changed, std::size_t meeting_row);

  void apply();

  /// y_j of the last step at a depth, for every term.
  void solutions_at(const DepthTap& tap, std::span<std::complex<double>> y) const;

 private:
  using Vector [[gnu::vector_size(32)]] = double;  // four lanes: one register of AVX2, two of NEON
  static constexpr std::size_t kLanes = 4;
  struct Rows {  // right-hand sides of the eliminations
    std::vector<double> re, im;
  };
  template <std::size_t V>
  struct Kernel;

  void copy_mass(const Tridiagonal& mass, RowRange rows);
  void multiply_by_mass(RowRange rows, Rows& product) const;

  std::size_t intervals_;
  std::size_t terms_;
  std::size_t vectors_;  // per complex number of all terms
  std::vector<double> re_, im_;
  std::vector<double> diagonal_re_, diagonal_im_, off_re_, off_im_;  // M
  Rows right_, old_product_;
  RowRange stepped_;              // rows whose medium changed since the last step
  bool started_ = false;          // there has been a step
  std::vector<Vector> scale_;     // -1 / pole, residue, 1 / residue: re and im each
  std::vector<Vector> factors_;   // [row][multiplier re, im; scaled inverse pivot re, im][vectors_]
  std::vector<Vector> meeting_;   // the same four for the row where the eliminations meet
  std::vector<Vector> solution_;  // [row][re, im][vectors_]
  std::size_t valid_top_ = 0;     // factors from the top are good to this row
  std::size_t valid_bottom_;      // factors from the bottom are good from this row on
  std::size_t meeting_row_ = 0;   // the last row eliminated from the top
};

}  // namespace earshot::pe
