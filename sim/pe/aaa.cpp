#include "sim/pe/aaa.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Quotient of two barycentric sums over the support points; equal to the samples there.
struct Barycentric {
  std::vector<std::size_t> support;  ///< indices of samples
  VectorXcd weight;

  [[nodiscard]] bool has(std::size_t sample) const { return std::find(support.begin(), support.end(), sample) != support.end(); }

  [[nodiscard]] Complex at_sample(const Samples& samples, std::size_t i) const {
    Complex numerator = 0.0;
    Complex denominator = 0.0;
    for (std::size_t j = 0; j < support.size(); ++j) {
      const Complex share = weight[static_cast<Index>(j)] / (samples.x[i] - samples.x[support[j]]);
      numerator += share * samples.value[support[j]];
      denominator += share;
    }
    return numerator / denominator;
  }
};

/// The weights that make the linearised weighted error least.
VectorXcd least_singular_vector(const Samples& samples, const Barycentric& fit) {
  MatrixXcd loewner(static_cast<Index>(samples.x.size() - fit.support.size()), static_cast<Index>(fit.support.size()));
  Index row = 0;
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    if (fit.has(i)) continue;
    for (Index j = 0; j < loewner.cols(); ++j) {
      const std::size_t s = fit.support[at(j)];
      loewner(row, j) = samples.weight[i] * (samples.value[i] - samples.value[s]) / (samples.x[i] - samples.x[s]);
    }
    ++row;
  }
  // The triangle of a QR factorisation has the same right singular vectors and is small.
  const MatrixXcd r = loewner.householderQr().matrixQR().topRows(loewner.cols()).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<MatrixXcd> svd(r, Eigen::ComputeFullV);
  return svd.matrixV().rightCols(1);
}

Barycentric greedy_fit(const Samples& samples, std::size_t terms) {
  Barycentric fit;
  while (fit.support.size() <= terms) {
    std::size_t worst = 0;
    double largest = -1.0;
    for (std::size_t i = 0; i < samples.x.size(); ++i) {
      if (fit.has(i)) continue;
      const Complex approximation = fit.support.empty() ? Complex(0.0) : fit.at_sample(samples, i);
      const double error = samples.weight[i] * std::abs(samples.value[i] - approximation);
      if (error > largest) largest = error, worst = i;
    }
    fit.support.push_back(worst);
    fit.weight = least_singular_vector(samples, fit);
  }
  return fit;
}

/// Zeros of the barycentric denominator: the finite eigenvalues of an arrowhead pencil (E, B), found as those of (E - shift B)^-1 B.
std::vector<Complex> poles(const Samples& samples, const Barycentric& fit) {
  const Complex shift(0.5, 2.0);  // away from the poles, which lie near the samples or below the real axis
  const Index count = fit.weight.size();
  MatrixXcd e = MatrixXcd::Zero(count + 1, count + 1);
  MatrixXcd b = MatrixXcd::Zero(count + 1, count + 1);
  for (Index j = 0; j < count; ++j) {
    e(0, j + 1) = fit.weight[j];
    e(j + 1, 0) = 1.0;
    e(j + 1, j + 1) = samples.x[fit.support[at(j)]] - shift;
    b(j + 1, j + 1) = 1.0;
  }
  const Eigen::ComplexEigenSolver<MatrixXcd> solver(e.partialPivLu().solve(b), false);
  std::vector<Complex> inverse(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::sort(inverse.begin(), inverse.end(), [](Complex x, Complex y) { return std::abs(x) > std::abs(y); });
  std::vector<Complex> pole;
  for (std::size_t j = 0; j + 1 < at(count); ++j) pole.push_back(shift + 1.0 / inverse[j]);  // the last two are the pencil's infinite ones
  return pole;
}

/// Constant and residues by weighted least squares for given poles.
Rational with_residues(const Samples& samples, const std::vector<Complex>& pole) {
  const auto terms = static_cast<Index>(pole.size());
  MatrixXcd basis(static_cast<Index>(samples.x.size()), terms + 1);
  VectorXcd right(basis.rows());
  for (Index i = 0; i < basis.rows(); ++i) {
    const double weight = samples.weight[at(i)];
    for (Index j = 0; j < terms; ++j) basis(i, j) = weight / (1.0 - samples.x[at(i)] / pole[at(j)]);
    basis(i, terms) = weight;
    right[i] = weight * samples.value[at(i)];
  }
  const VectorXcd solution = basis.colPivHouseholderQr().solve(right);
  Rational rational{solution[terms], {}, {}};
  for (Index j = 0; j < terms; ++j) {
    rational.pole.push_back(-1.0 / pole[at(j)]);
    rational.residue.push_back(solution[j]);
  }
  return rational;
}

}  // namespace

Rational fit_rational(const Samples& samples, std::size_t terms) {
  assert(terms > 0 && samples.x.size() >= 3 * terms);
  return with_residues(samples, poles(samples, greedy_fit(samples, terms)));
}

double weighted_error(const Rational& rational, const Samples& samples) {
  double largest = 0.0;
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    largest = std::max(largest, samples.weight[i] * std::abs(rational(samples.x[i]) - samples.value[i]));
  }
  return largest;
}

}  // namespace earshot::pe
