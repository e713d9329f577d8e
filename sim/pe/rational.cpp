#include "sim/pe/rational.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;

/// The barycentric form n(x) / d(x) = sum_k w_k f_k / (x - z_k)  /  sum_k w_k / (x - z_k) under construction.
class Barycentric {
 public:
  explicit Barycentric(const Samples& samples) : samples_(samples), is_support_(samples.x.size(), false), approximation_(samples.value) {
    Complex mean = 0.0;
    for (const Complex value : samples.value) mean += value / static_cast<double>(samples.value.size());
    std::fill(approximation_.begin(), approximation_.end(), mean);
  }

  /// Takes the sample with the largest weighted error as the next support point.
  void add_support() {
    std::size_t worst = 0;
    double largest = -1.0;
    for (std::size_t i = 0; i < is_support_.size(); ++i) {
      const double error = samples_.weight[i] * std::abs(samples_.value[i] - approximation_[i]);
      if (!is_support_[i] && error > largest) largest = error, worst = i;
    }
    is_support_[worst] = true;
    support_.push_back(worst);
  }

  /// Weights that minimise the linearised error |n - f d| by the normal equations: enough to find the next support point.
  void solve_roughly() {
    const Eigen::MatrixXcd loewner = loewner_matrix();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(loewner.adjoint() * loewner);
    weights_ = eigen.eigenvectors().col(0);
    evaluate();
  }

  /// The same to full precision, over the weights with sum_k w_k f_k = 0, that is with R(infinity) = 0.
  void solve_vanishing_at_infinity() {
    const auto n = static_cast<Eigen::Index>(support_.size());
    Eigen::VectorXcd f(n);
    for (Eigen::Index k = 0; k < n; ++k) f(k) = std::conj(samples_.value[support_[static_cast<std::size_t>(k)]]);
    const Eigen::MatrixXcd q = Eigen::HouseholderQR<Eigen::MatrixXcd>(f).householderQ();
    const Eigen::MatrixXcd allowed = q.rightCols(n - 1);
    const Eigen::MatrixXcd triangle =
        Eigen::HouseholderQR<Eigen::MatrixXcd>(loewner_matrix() * allowed).matrixQR().topRows(n - 1).triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(triangle, Eigen::ComputeFullV);
    weights_ = allowed * svd.matrixV().col(n - 2);
  }

  /// Zeros of d(x): eigenvalues of diag(z) - 1 v^T with v_k = w_k (z_k - c) / sum w, which are those of (x - c) d(x).
  [[nodiscard]] std::vector<Complex> poles() const {
    const auto n = static_cast<Eigen::Index>(support_.size());
    constexpr double kAway = 3.3;  // c: any point away from the samples and the poles
    Eigen::MatrixXcd companion(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double z = samples_.x[support_[static_cast<std::size_t>(k)]];
      companion.col(k).setConstant(-weights_(k) * (z - kAway) / weights_.sum());
      companion(k, k) += z;
    }
    const Eigen::VectorXcd eigenvalues = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(companion, false).eigenvalues();
    Eigen::Index away = 0;
    (eigenvalues.array() - kAway).abs().minCoeff(&away);
    std::vector<Complex> result;
    for (Eigen::Index k = 0; k < n; ++k)
      if (k != away) result.push_back(eigenvalues(k));
    return result;
  }

 private:
  [[nodiscard]] Eigen::MatrixXcd loewner_matrix() const {
    Eigen::MatrixXcd loewner(static_cast<Eigen::Index>(is_support_.size() - support_.size()), static_cast<Eigen::Index>(support_.size()));
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < is_support_.size(); ++i) {
      if (is_support_[i]) continue;
      for (std::size_t k = 0; k < support_.size(); ++k) {
        const std::size_t s = support_[k];
        loewner(row, static_cast<Eigen::Index>(k)) =
            samples_.weight[i] * (samples_.value[i] - samples_.value[s]) / (samples_.x[i] - samples_.x[s]);
      }
      ++row;
    }
    return loewner;
  }

  void evaluate() {
    for (std::size_t i = 0; i < is_support_.size(); ++i) {
      if (is_support_[i]) continue;
      Complex numerator = 0.0;
      Complex denominator = 0.0;
      for (std::size_t k = 0; k < support_.size(); ++k) {
        const Complex term = weights_(static_cast<Eigen::Index>(k)) / (samples_.x[i] - samples_.x[support_[k]]);
        numerator += term * samples_.value[support_[k]];
        denominator += term;
      }
      approximation_[i] = numerator / denominator;
    }
  }

  const Samples& samples_;
  std::vector<bool> is_support_;
  std::vector<std::size_t> support_;
  std::vector<Complex> approximation_;
  Eigen::VectorXcd weights_;
};

}  // namespace

std::complex<double> Rational::operator()(std::complex<double> x) const {
  Complex sum = 0.0;
  for (std::size_t j = 0; j < pole.size(); ++j) sum += residue[j] / (1.0 - x / pole[j]);
  return sum;
}

std::vector<std::complex<double>> fit_poles(const Samples& samples, std::size_t terms) {
  Barycentric fit(samples);
  for (std::size_t k = 0; k < terms; ++k) {
    fit.add_support();
    fit.solve_roughly();
  }
  fit.add_support();
  fit.solve_vanishing_at_infinity();
  std::vector<Complex> poles = fit.poles();
  for (const Complex pole : poles) {
    if (!std::isfinite(pole.real()) || !std::isfinite(pole.imag())) throw std::runtime_error("a rational fit has a pole that is no number");
  }
  return poles;
}

ResidueFit::ResidueFit(std::span<const double> x, std::span<const double> weight, std::span<const std::complex<double>> pole)
    : weight_(Eigen::VectorXd::Map(weight.data(), static_cast<Eigen::Index>(weight.size()))) {
  Eigen::MatrixXcd matrix(weight_.size(), static_cast<Eigen::Index>(pole.size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      matrix(i, j) = weight_(i) / (1.0 - x[static_cast<std::size_t>(i)] / pole[static_cast<std::size_t>(j)]);
  }
  factors_.compute(matrix);
}

std::vector<std::complex<double>> ResidueFit::residues(std::span<const std::complex<double>> value) const {
  const Eigen::VectorXcd right = weight_.cwiseProduct(Eigen::VectorXcd::Map(value.data(), weight_.size()));
  const Eigen::VectorXcd solution = factors_.solve(right);
  return {solution.begin(), solution.end()};
}

}  // namespace earshot::pe
