#include "sim/pe/rational/rational.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

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

  /// Weights that minimise the linearised error |n - f d|, roughly: enough to find the next support point.
  void solve_roughly() {
    constexpr int kIterations = 4;
    weights_ = PivotedQr(loewner_matrix()).least_singular_vector(kIterations);
    evaluate();
  }

  /// The same to full precision, over the weights with sum_k w_k f_k = 0, that is with R(infinity) = 0: a reflection that turns f's
  /// conjugate to the first axis leaves the others for them.
  void solve_vanishing_at_infinity() {
    std::vector<Complex> f;
    for (const std::size_t support : support_) f.push_back(std::conj(samples_.value[support]));
    const Reflector reflector = reflector_of(f);
    SmallMatrix loewner = loewner_matrix();
    reflector.apply_from_right(loewner, 0);
    SmallMatrix allowed(loewner.rows(), loewner.columns() - 1);
    for (std::size_t k = 0; k < allowed.columns(); ++k) std::ranges::copy(loewner.column(k + 1), allowed.column(k).begin());
    constexpr int kIterations = 100;
    const std::vector<Complex> along_axes = PivotedQr(std::move(allowed)).least_singular_vector(kIterations);
    weights_.assign(1, 0.0);
    weights_.insert(weights_.end(), along_axes.begin(), along_axes.end());
    reflector.apply(weights_);
  }

  /// Zeros of d(x): eigenvalues of diag(z) - 1 v^T with v_k = w_k (z_k - c) / sum w, which are those of (x - c) d(x).
  [[nodiscard]] std::vector<Complex> poles() const {
    const std::size_t n = support_.size();
    constexpr double kAway = 3.3;  // c: any point away from the samples and the poles
    const Complex sum = std::accumulate(weights_.begin(), weights_.end(), Complex(0.0));
    SmallMatrix companion(n, n);
    for (std::size_t k = 0; k < n; ++k) {
      const double z = samples_.x[support_[k]];
      std::ranges::fill(companion.column(k), -weights_[k] * (z - kAway) / sum);
      companion(k, k) += z;
    }
    std::vector<Complex> result = eigenvalues(std::move(companion));
    result.erase(std::ranges::min_element(result, {}, [=](Complex pole) { return std::abs(pole - kAway); }));
    return result;
  }

 private:
  [[nodiscard]] SmallMatrix loewner_matrix() const {
    SmallMatrix loewner(is_support_.size() - support_.size(), support_.size());
    std::size_t row = 0;
    for (std::size_t i = 0; i < is_support_.size(); ++i) {
      if (is_support_[i]) continue;
      for (std::size_t k = 0; k < support_.size(); ++k) {
        const std::size_t s = support_[k];
        loewner(row, k) = samples_.weight[i] * (samples_.value[i] - samples_.value[s]) / (samples_.x[i] - samples_.x[s]);
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
        const Complex term = weights_[k] / (samples_.x[i] - samples_.x[support_[k]]);
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
  std::vector<Complex> weights_;
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

namespace {

/// One column for each pole: weight / (1 - x / pole).
SmallMatrix weighted_poles(std::span<const double> x, std::span<const double> weight, std::span<const Complex> pole) {
  SmallMatrix matrix(x.size(), pole.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < pole.size(); ++j) matrix(i, j) = weight[i] / (1.0 - x[i] / pole[j]);
  }
  return matrix;
}

}  // namespace

ResidueFit::ResidueFit(std::span<const double> x, std::span<const double> weight, std::span<const std::complex<double>> pole)
    : weight_(weight.begin(), weight.end()), factors_(weighted_poles(x, weight, pole)) {}

std::vector<std::complex<double>> ResidueFit::residues(std::span<const std::complex<double>> value) const {
  std::vector<Complex> right;
  for (std::size_t i = 0; i < value.size(); ++i) right.push_back(weight_[i] * value[i]);
  return factors_.least_squares(right);
}

}  // namespace earshot::pe
