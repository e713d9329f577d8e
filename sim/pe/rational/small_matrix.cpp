#include "sim/pe/rational/small_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace earshot::pe {
namespace {

using Complex = SmallMatrix::Complex;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double length(std::span<const Complex> x) {
  double sum = 0.0;
  for (const Complex value : x) sum += std::norm(value);
  return std::sqrt(sum);
}

/// c real, s complex: (c s; -s* c) turns (a, b) to (r, 0).
struct Rotation {
  double c;
  Complex s;
};

Rotation rotation_of(Complex a, Complex b) {
  const double r = std::hypot(std::abs(a), std::abs(b));
  if (r == 0.0) return {1.0, 0.0};
  if (a == 0.0) return {0.0, std::conj(b) / std::abs(b)};
  return {std::abs(a) / r, a / std::abs(a) * std::conj(b) / r};
}

/// Similar to the matrix, and zero below the first subdiagonal.
void reduce_to_hessenberg(SmallMatrix& a) {
  for (std::size_t k = 0; k + 2 < a.rows(); ++k) {
    const Reflector reflector = reflector_of(a.column(k).subspan(k + 1));
    for (std::size_t j = k; j < a.columns(); ++j) reflector.apply(a.column(j).subspan(k + 1));
    reflector.apply_from_right(a, k + 1);
  }
}

/// Of the last two rows and columns, the eigenvalue nearer to the last diagonal element (Wilkinson).
Complex shift_of(const SmallMatrix& h, std::size_t last) {
  const Complex half = 0.5 * (h(last - 1, last - 1) - h(last, last));
  const Complex product = h(last - 1, last) * h(last, last - 1);
  const Complex root = std::sqrt(half * half + product);
  const Complex away = std::abs(half + root) >= std::abs(half - root) ? half + root : half - root;
  return away == 0.0 ? h(last, last) : h(last, last) - product / away;
}

/// H - shift = Q R, then H = R Q + shift, on rows and columns `first` to `last`, which no others are coupled to from below.
void qr_step(SmallMatrix& h, std::size_t first, std::size_t last, Complex shift) {
  for (std::size_t i = first; i <= last; ++i) h(i, i) -= shift;
  std::vector<Rotation> rotations;
  for (std::size_t k = first; k < last; ++k) {
    const auto [c, s] = rotations.emplace_back(rotation_of(h(k, k), h(k + 1, k)));
    for (std::size_t j = k; j <= last; ++j) {
      const Complex upper = h(k, j);
      h(k, j) = c * upper + s * h(k + 1, j);
      h(k + 1, j) = c * h(k + 1, j) - std::conj(s) * upper;
    }
  }
  for (std::size_t k = first; k < last; ++k) {
    const auto [c, s] = rotations[k - first];
    for (std::size_t i = first; i <= k + 1; ++i) {
      const Complex left = h(i, k);
      h(i, k) = c * left + std::conj(s) * h(i, k + 1);
      h(i, k + 1) = c * h(i, k + 1) - s * left;
    }
  }
  for (std::size_t i = first; i <= last; ++i) h(i, i) += shift;
}

bool is_negligible(const SmallMatrix& h, std::size_t row) {
  return std::abs(h(row, row - 1)) <= kEpsilon * (std::abs(h(row, row)) + std::abs(h(row - 1, row - 1)));
}

}  // namespace

Reflector reflector_of(std::span<const Complex> x) {
  Reflector result{{x.begin(), x.end()}};
  const double norm = length(x);
  if (norm == 0.0) return result;
  const double first = std::abs(x[0]);
  result.v[0] += first == 0.0 ? Complex(norm) : x[0] / first * norm;  // the sign that does not cancel
  const double scale = 1.0 / length(result.v);
  for (Complex& value : result.v) value *= scale;
  return result;
}

void Reflector::apply(std::span<Complex> x) const {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += std::conj(v[i]) * x[i];
  for (std::size_t i = 0; i < v.size(); ++i) x[i] -= 2.0 * sum * v[i];
}

void Reflector::apply_from_right(SmallMatrix& matrix, std::size_t column) const {
  for (std::size_t row = 0; row < matrix.rows(); ++row) {
    Complex sum = 0.0;
    for (std::size_t j = 0; j < v.size(); ++j) sum += matrix(row, column + j) * v[j];
    for (std::size_t j = 0; j < v.size(); ++j) matrix(row, column + j) -= 2.0 * sum * std::conj(v[j]);
  }
}

PivotedQr::PivotedQr(SmallMatrix matrix) : r_(std::move(matrix)), order_(r_.columns()) {
  std::iota(order_.begin(), order_.end(), 0U);
  for (std::size_t k = 0; k < r_.columns(); ++k) {
    std::size_t longest = k;
    double most = -1.0;
    for (std::size_t j = k; j < r_.columns(); ++j) {
      const double left = length(r_.column(j).subspan(k));
      if (left > most) most = left, longest = j;
    }
    if (longest != k) std::ranges::swap_ranges(r_.column(k), r_.column(longest));
    std::swap(order_[k], order_[longest]);
    const Reflector& reflector = reflectors_.emplace_back(reflector_of(r_.column(k).subspan(k)));
    for (std::size_t j = k; j < r_.columns(); ++j) reflector.apply(r_.column(j).subspan(k));
  }
}

/// A diagonal element, or what rounding would leave of one that vanishes.
Complex PivotedQr::pivot(std::size_t k) const {
  const double least = kEpsilon * std::abs(r_(0, 0));
  return std::abs(r_(k, k)) > least ? r_(k, k) : Complex(std::max(least, std::numeric_limits<double>::min()));
}

std::vector<Complex> PivotedQr::least_squares(std::span<const Complex> b) const {
  std::vector<Complex> y(b.begin(), b.end());
  for (std::size_t k = 0; k < reflectors_.size(); ++k) reflectors_[k].apply(std::span(y).subspan(k));
  std::vector<Complex> x(order_.size());
  for (std::size_t k = order_.size(); k-- > 0;) {
    if (!(std::abs(r_(k, k)) > kEpsilon * std::abs(r_(0, 0)))) continue;
    Complex sum = y[k];
    for (std::size_t j = k + 1; j < order_.size(); ++j) sum -= r_(k, j) * x[order_[j]];
    x[order_[k]] = sum / r_(k, k);
  }
  return x;
}

std::vector<Complex> PivotedQr::least_singular_vector(int most_iterations) const {
  const std::size_t n = order_.size();
  std::vector<Complex> x(n);
  x[n - 1] = 1.0;
  double moved = 1.0;
  for (int iteration = 0; iteration < most_iterations && moved > 4.0 * kEpsilon; ++iteration) {
    std::vector<Complex> next = x;
    for (std::size_t k = 0; k < n; ++k) {  // R^H y = x
      for (std::size_t j = 0; j < k; ++j) next[k] -= std::conj(r_(j, k)) * next[j];
      next[k] /= std::conj(pivot(k));
    }
    for (std::size_t k = n; k-- > 0;) {  // R x = y
      for (std::size_t j = k + 1; j < n; ++j) next[k] -= r_(k, j) * next[j];
      next[k] /= pivot(k);
    }
    const double scale = 1.0 / length(next);
    moved = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      next[k] *= scale;
      moved = std::max(moved, std::abs(next[k] - x[k]));
    }
    x = std::move(next);
  }
  std::vector<Complex> result(n);
  for (std::size_t k = 0; k < n; ++k) result[order_[k]] = x[k];
  return result;
}

std::vector<Complex> eigenvalues(SmallMatrix h) {
  reduce_to_hessenberg(h);
  constexpr int kMostSteps = 100;  // for one eigenvalue; three are usual
  int steps = 0;
  for (std::size_t last = h.rows() - 1; last > 0;) {
    if (is_negligible(h, last)) {
      --last;
      steps = 0;
      continue;
    }
    if (++steps > kMostSteps) throw std::runtime_error("the eigenvalues of a small matrix do not converge");
    std::size_t first = last;
    while (first > 0 && !is_negligible(h, first)) --first;
    // Every tenth step another shift, should the usual one go round in circles.
    qr_step(h, first, last, steps % 10 == 0 ? h(last, last) + std::abs(h(last, last - 1)) : shift_of(h, last));
  }
  std::vector<Complex> result;
  for (std::size_t i = 0; i < h.rows(); ++i) result.push_back(h(i, i));
  return result;
}

}  // namespace earshot::pe
