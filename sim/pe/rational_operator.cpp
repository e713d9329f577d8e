#include "sim/pe/rational_operator.hpp"

#include <algorithm>
#include <cassert>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;
}  // namespace

void RationalOperator::Lanes::set(std::size_t lane, Complex value) {
  const std::size_t i = lane % kLanesPerVector;
  (lane < kLanesPerVector ? re0 : re1)[i] = value.real();
  (lane < kLanesPerVector ? im0 : im1)[i] = value.imag();
}

inline Complex RationalOperator::Lanes::sum() const {
  const Vector re = re0 + re1;
  const Vector im = im0 + im1;
  return {(re[0] + re[1]) + (re[2] + re[3]), (im[0] + im[1]) + (im[2] + im[3])};
}

inline void RationalOperator::Lanes::subtract_product(const Lanes& a, const Lanes& b) {
  re0 = re0 - a.re0 * b.re0 + a.im0 * b.im0;
  re1 = re1 - a.re1 * b.re1 + a.im1 * b.im1;
  im0 = im0 - a.re0 * b.im0 - a.im0 * b.re0;
  im1 = im1 - a.re1 * b.im1 - a.im1 * b.re1;
}

inline RationalOperator::Lanes RationalOperator::Lanes::scaled(const Lanes& a, Complex factor) {
  const double re = factor.real();
  const double im = factor.imag();
  return {a.re0 * re - a.im0 * im, a.re0 * im + a.im0 * re, a.re1 * re - a.im1 * im, a.re1 * im + a.im1 * re};
}

RationalOperator::RationalOperator(const DepthOperator& depth_operator, const Rational& rational)
    : constant_(rational.constant), mass_(depth_operator.mass), right_(depth_operator.size()), forward_(depth_operator.size()) {
  for (std::size_t first = 0; first < rational.pole.size(); first += kLanes) groups_.push_back(factorise(depth_operator, rational, first));
}

RationalOperator::Group RationalOperator::factorise(const DepthOperator& depth_operator, const Rational& rational, std::size_t first_pole) {
  Group group(depth_operator.size());  // lanes without a pole keep zero factors and add nothing
  const std::size_t poles = std::min(kLanes, rational.pole.size() - first_pole);
  const auto& [mass, g] = depth_operator;
  for (std::size_t lane = 0; lane < poles; ++lane) {
    const Complex pole = rational.pole[first_pole + lane];
    Complex below = 0.0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Complex lower = mass.lower[i] + pole * g.lower[i];
      const Complex pivot = mass.diagonal[i] + pole * g.diagonal[i] - lower * below;
      below = (mass.upper[i] + pole * g.upper[i]) / pivot;
      group[i].right.set(lane, rational.residue[first_pole + lane] / pivot);
      group[i].above.set(lane, lower / pivot);
      group[i].below.set(lane, below);
    }
  }
  return group;
}

void RationalOperator::apply(std::span<Complex> p) {
  assert(p.size() == size());
  multiply_by_mass(p);
  for (Complex& value : p) value *= constant_;
  for (const Group& group : groups_) add_solutions(group, p);
}

void RationalOperator::multiply_by_mass(std::span<const Complex> p) {
  const std::size_t last = p.size() - 1;
  right_[0] = mass_.diagonal[0] * p[0] + mass_.upper[0] * p[1];
  for (std::size_t i = 1; i < last; ++i) right_[i] = mass_.lower[i] * p[i - 1] + mass_.diagonal[i] * p[i] + mass_.upper[i] * p[i + 1];
  right_[last] = mass_.lower[last] * p[last - 1] + mass_.diagonal[last] * p[last];
}

void RationalOperator::add_solutions(const Group& group, std::span<Complex> p) {
  Lanes x{};
  for (std::size_t i = 0; i < group.size(); ++i) {
    Lanes row = Lanes::scaled(group[i].right, right_[i]);
    row.subtract_product(group[i].above, x);
    forward_[i] = x = row;
  }
  x = Lanes{};
  for (std::size_t i = group.size(); i-- > 0;) {
    Lanes row = forward_[i];
    row.subtract_product(group[i].below, x);
    x = row;
    p[i] += x.sum();
  }
}

}  // namespace earshot::pe
