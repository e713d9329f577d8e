#include "sim/pe/rational.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace earshot::pe {
namespace {

using Series = std::vector<Wide>;
using WideMatrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>;
using WideVector = Eigen::Matrix<Wide, Eigen::Dynamic, 1>;

/// sqrt(1 + x)
Series square_root(std::size_t count) {
  Series series(count);
  series[0] = 1.0L;
  for (std::size_t k = 1; k < count; ++k) {
    const auto order = static_cast<long double>(k);
    series[k] = series[k - 1] * ((1.5L - order) / order);
  }
  return series;
}

/// exp(a(x)) for a(0) = 0, from k e_k = sum_j j a_j e_(k-j).
Series exponential(const Series& a) {
  Series series(a.size());
  series[0] = 1.0L;
  for (std::size_t k = 1; k < a.size(); ++k) {
    for (std::size_t j = 1; j <= k; ++j) series[k] += static_cast<long double>(j) * a[j] * series[k - j];
    series[k] /= static_cast<long double>(k);
  }
  return series;
}

struct Polynomial {
  WideVector coefficient;  ///< of x^k

  [[nodiscard]] Wide operator()(Wide x) const {
    Wide value = 0.0L;
    for (Eigen::Index k = coefficient.size(); k-- > 0;) value = value * x + coefficient[k];
    return value;
  }
  [[nodiscard]] Polynomial derivative() const {
    Polynomial result{WideVector(coefficient.size() - 1)};
    for (Eigen::Index k = 1; k < coefficient.size(); ++k) result.coefficient[k - 1] = static_cast<long double>(k) * coefficient[k];
    return result;
  }
};

/// All roots at once by Ehrlich and Aberth's iteration.
std::vector<Wide> roots(const Polynomial& p) {
  const auto degree = static_cast<std::size_t>(p.coefficient.size() - 1);
  const Polynomial slope = p.derivative();
  const long double radius =
      std::pow(std::abs(p.coefficient[0] / p.coefficient[p.coefficient.size() - 1]), 1.0L / static_cast<long double>(degree));
  std::vector<Wide> root(degree);
  for (std::size_t i = 0; i < degree; ++i)
    root[i] = std::polar(radius, 0.4L + 6.2831853L * static_cast<long double>(i) / static_cast<long double>(degree));
  constexpr int kMaxIterations = 500;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    long double largest_correction = 0.0L;
    for (std::size_t i = 0; i < degree; ++i) {
      const Wide newton = p(root[i]) / slope(root[i]);
      Wide repulsion = 0.0L;
      for (std::size_t j = 0; j < degree; ++j) {
        if (j != i) repulsion += 1.0L / (root[i] - root[j]);
      }
      const Wide correction = newton / (1.0L - newton * repulsion);
      root[i] -= correction;
      largest_correction = std::max(largest_correction, std::abs(correction) / std::abs(root[i]));
    }
    // A NaN never compares below, so a breakdown ends as a failure.
    if (largest_correction < 1e-14L) return root;
  }
  throw std::runtime_error("the poles of a Pade approximant with " + std::to_string(degree) + " terms cannot be found; use fewer terms");
}

std::complex<double> narrow(Wide x) {
  return {static_cast<double>(x.real()), static_cast<double>(x.imag())};
}

struct Quotient {
  Polynomial numerator;
  Polynomial denominator;
};

/// Solves for numerator and denominator with equal Taylor coefficients up to order 2n.
Quotient solve_pade_system(std::span<const Wide> taylor_coefficients, std::size_t terms) {
  const auto n = static_cast<Eigen::Index>(terms);
  const auto f = [&](Eigen::Index k) { return taylor_coefficients[static_cast<std::size_t>(k)]; };
  WideMatrix matrix = WideMatrix::Zero(2 * n, 2 * n);  // unknowns: a_1..a_n, b_1..b_n
  WideVector right(2 * n);
  for (Eigen::Index k = 1; k <= 2 * n; ++k) {
    if (k <= n) matrix(k - 1, k - 1) = 1.0L;
    for (Eigen::Index j = 1; j <= std::min(k, n); ++j) matrix(k - 1, n + j - 1) = -f(k - j);
    right[k - 1] = f(k);
  }
  const WideVector solution = matrix.fullPivLu().solve(right);
  Quotient quotient{{WideVector(n + 1)}, {WideVector(n + 1)}};
  quotient.numerator.coefficient << f(0), solution.head(n);
  quotient.denominator.coefficient << Wide(1.0L), solution.tail(n);
  return quotient;
}

/// What the diagonal approximant of a range step is in exact arithmetic.
bool is_unitary(const Rational& step) {
  constexpr double kGrowth = 1e-4;
  for (double x = -1.0; x > -1e4; x *= 1.05) {
    for (const double at : {x, 1.2 + x}) {
      if (!(std::abs(std::abs(step(at)) - 1.0) < kGrowth)) return false;
    }
  }
  return std::all_of(step.pole.begin(), step.pole.end(), [](std::complex<double> pole) { return (-1.0 / pole).imag() < 0.0; });
}

}  // namespace

std::complex<double> Rational::operator()(std::complex<double> x) const {
  std::complex<double> sum = constant;
  for (std::size_t j = 0; j < pole.size(); ++j) sum += residue[j] / (1.0 + pole[j] * x);
  return sum;
}

std::vector<Wide> taylor_of_step(long double phase, std::size_t count) {
  Series exponent = square_root(count);
  exponent[0] = 0.0L;
  for (Wide& coefficient : exponent) coefficient *= Wide(0.0L, phase);
  return exponential(exponent);
}

Rational pade(std::span<const Wide> taylor_coefficients, std::size_t terms) {
  const Quotient quotient = solve_pade_system(taylor_coefficients, terms);
  const Polynomial slope = quotient.denominator.derivative();
  const auto n = static_cast<Eigen::Index>(terms);
  Rational rational{narrow(quotient.numerator.coefficient[n] / quotient.denominator.coefficient[n]), {}, {}};
  for (const Wide& root : roots(quotient.denominator)) {
    rational.pole.push_back(narrow(-1.0L / root));
    rational.residue.push_back(narrow(-quotient.numerator(root) / (slope(root) * root)));
  }
  return rational;
}

Rational propagator(double phase, std::size_t terms) {
  Rational step = pade(taylor_of_step(static_cast<long double>(phase), 2 * terms + 1), terms);
  if (!is_unitary(step)) {
    throw std::runtime_error("a Pade approximant of " + std::to_string(terms) + " terms for a step of " + std::to_string(phase) +
                             " rad is beyond the working accuracy; use fewer terms or a longer step");
  }
  return step;
}

}  // namespace earshot::pe
