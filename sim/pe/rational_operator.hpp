#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/pe/depth_operator.hpp"
#include "sim/pe/rational.hpp"

namespace earshot::pe {

/// R(X) ready to be applied: every pole's tridiagonal matrix M + pole_j G is factorised once, here, and applied many times without
/// allocating.
///
///   R(X) p = constant p + sum_j residue_j (M + pole_j G)^-1 M p
///
/// All poles are swept together, one to a vector lane, over the one right-hand side M p.
/// Oracle: RationalOperator.SolvesWhatAnEliminationInEigenSolves
class RationalOperator {
 public:
  RationalOperator(const DepthOperator& depth_operator, const Rational& rational);

  /// p <- R(X) p over the nodes below the surface (`size()` of them).
  void apply(std::span<std::complex<double>> p);

  [[nodiscard]] std::size_t size() const { return mass_.diagonal.size(); }

 private:
  using Vector [[gnu::vector_size(32)]] = double;  // four lanes: one register of AVX2, two of NEON
  static constexpr std::size_t kLanesPerVector = 4;
  static constexpr std::size_t kLanes = 2 * kLanesPerVector;

  struct Lanes {  ///< one complex number of every pole of a group
    Vector re0, im0, re1, im1;
    void set(std::size_t lane, std::complex<double> value);
    [[nodiscard]] std::complex<double> sum() const;
    void subtract_product(const Lanes& a, const Lanes& b);
    static Lanes scaled(const Lanes& a, std::complex<double> factor);
  };
  struct Row {
    Lanes right;  ///< residue / pivot: weight of the right-hand side
    Lanes above;  ///< lower / pivot: what the forward sweep takes from the row above
    Lanes below;  ///< upper / pivot: what the backward sweep takes from the row below
  };
  using Group = std::vector<Row>;  ///< the factors of up to kLanes poles

  static Group factorise(const DepthOperator& depth_operator, const Rational& rational, std::size_t first_pole);
  void multiply_by_mass(std::span<const std::complex<double>> p);
  void add_solutions(const Group& group, std::span<std::complex<double>> p);

  std::complex<double> constant_;
  Tridiagonal mass_;
  std::vector<Group> groups_;
  std::vector<std::complex<double>> right_;
  std::vector<Lanes> forward_;
};

}  // namespace earshot::pe
