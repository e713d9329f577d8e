#include "sim/pe/sweep.hpp"

#include <algorithm>

namespace earshot::pe {

/// The loops over rows, for V vectors of four terms.
template <std::size_t V>
struct Sweep::Kernel {
  /// One complex number of every term; in registers.
  struct Lanes {
    Vector re[V];
    Vector im[V];

    static Lanes load(const Vector* from) {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) a.re[v] = from[v], a.im[v] = from[V + v];
      return a;
    }
    void store(Vector* to) const {
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) to[v] = re[v], to[V + v] = im[v];
    }
    static Lanes zero() {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) a.re[v] = a.im[v] = Vector{};
      return a;
    }
    static Lanes all(double re, double im) {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) a.re[v] = Vector{re, re, re, re}, a.im[v] = Vector{im, im, im, im};
      return a;
    }
    /// this + b c, and this - b c
    [[nodiscard]] Lanes plus(const Lanes& b, const Lanes& c) const {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) {
        a.re[v] = re[v] + b.re[v] * c.re[v] - b.im[v] * c.im[v];
        a.im[v] = im[v] + b.re[v] * c.im[v] + b.im[v] * c.re[v];
      }
      return a;
    }
    [[nodiscard]] Lanes minus(const Lanes& b, const Lanes& c) const {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) {
        a.re[v] = re[v] - b.re[v] * c.re[v] + b.im[v] * c.im[v];
        a.im[v] = im[v] - b.re[v] * c.im[v] - b.im[v] * c.re[v];
      }
      return a;
    }
    [[nodiscard]] Lanes times(const Lanes& b) const {
      return zero().plus(*this, b);
    }
    [[nodiscard]] Lanes inverse() const {
      Lanes a;
#pragma GCC unroll 4
      for (std::size_t v = 0; v < V; ++v) {
        const Vector scale = 1.0 / (re[v] * re[v] + im[v] * im[v]);
        a.re[v] = re[v] * scale;
        a.im[v] = -im[v] * scale;
      }
      return a;
    }
  };

  static constexpr std::size_t kFactors = 4 * V;  // vectors of a row of factors
  static constexpr std::size_t kSolution = 2 * V;

  /// Pivots from row `row` on, `step` apart (1 from the top, -1 from the bottom), for `count` rows.
  static void factorise(Sweep& sweep, const DepthOperator& op, std::size_t row, std::size_t count, std::ptrdiff_t step) {
    const Lanes pole = Lanes::load(&sweep.scale_[0]);
    const Lanes residue = Lanes::load(&sweep.scale_[2 * V]);
    const Lanes inverse_residue = Lanes::load(&sweep.scale_[4 * V]);
    const auto matrix = [&pole](std::complex<double> m, std::complex<double> g) {
      return Lanes::all(m.real(), m.imag()).plus(pole, Lanes::all(g.real(), g.imag()));
    };
    const std::size_t end_row = step > 0 ? 1 : sweep.intervals_ - 1;
    Lanes inverse_pivot = Lanes::zero();
    if (row != end_row) {
      const std::size_t before = row - static_cast<std::size_t>(step);
      inverse_pivot = Lanes::load(&sweep.factors_[before * kFactors + 2 * V]).times(inverse_residue);
    }
    for (; count > 0; --count, row += static_cast<std::size_t>(step)) {
      const std::size_t link = step > 0 ? row - 1 : row;
      const Lanes off = matrix(op.mass().off[link], op.g().off[link]);
      const Lanes multiplier = off.times(inverse_pivot);
      inverse_pivot = matrix(op.mass().diagonal[row], op.g().diagonal[row]).minus(multiplier, off).inverse();
      multiplier.store(&sweep.factors_[row * kFactors]);
      inverse_pivot.times(residue).store(&sweep.factors_[row * kFactors + 2 * V]);
    }
  }

  /// The row below the meeting row, which has been eliminated from below, takes the row above it too.
  static void factorise_meeting(Sweep& sweep, const DepthOperator& op) {
    const Lanes pole = Lanes::load(&sweep.scale_[0]);
    const Lanes residue = Lanes::load(&sweep.scale_[2 * V]);
    const Lanes inverse_residue = Lanes::load(&sweep.scale_[4 * V]);
    const std::size_t row = sweep.meeting_row_;
    const std::complex<double> m = op.mass().off[row];
    const std::complex<double> g = op.g().off[row];
    const Lanes off = Lanes::all(m.real(), m.imag()).plus(pole, Lanes::all(g.real(), g.imag()));
    const Lanes above = Lanes::load(&sweep.factors_[row * kFactors + 2 * V]).times(inverse_residue);
    const Lanes below = Lanes::load(&sweep.factors_[(row + 1) * kFactors + 2 * V]).times(inverse_residue);
    const Lanes multiplier = off.times(above);
    const Lanes pivot = Lanes::all(1.0, 0.0).minus(multiplier.times(off), below).inverse().times(below);
    multiplier.store(&sweep.meeting_[0]);
    pivot.times(residue).store(&sweep.meeting_[2 * V]);
  }

  static Lanes eliminate(Sweep& sweep, std::size_t row, const Lanes& before) {
    const Lanes z = Lanes::all(sweep.right_.re[row], sweep.right_.im[row]).minus(Lanes::load(&sweep.factors_[row * kFactors]), before);
    z.store(&sweep.solution_[row * kSolution]);
    return z;
  }

  /// y = (residue / pivot) z - multiplier of the row that was eliminated with this one x its y.
  static Lanes substitute(Sweep& sweep, std::size_t row, const Vector* multiplier, const Lanes& after) {
    const Lanes z = Lanes::load(&sweep.solution_[row * kSolution]);
    const Lanes y = Lanes::zero().plus(Lanes::load(&sweep.factors_[row * kFactors + 2 * V]), z).minus(Lanes::load(multiplier), after);
    finish(sweep, row, y);
    return y;
  }

  static void finish(Sweep& sweep, std::size_t row, const Lanes& y) {
    y.store(&sweep.solution_[row * kSolution]);
    Vector re = y.re[0];
    Vector im = y.im[0];
#pragma GCC unroll 4
    for (std::size_t v = 1; v < V; ++v) re += y.re[v], im += y.im[v];
    const Vector pairs = __builtin_shufflevector(re, im, 0, 4, 2, 6) + __builtin_shufflevector(re, im, 1, 5, 3, 7);
    sweep.re_[row] = pairs[0] + pairs[2];
    sweep.im_[row] = pairs[1] + pairs[3];
  }

  static void apply(Sweep& sweep) {
    const std::size_t m = sweep.meeting_row_;
    const std::size_t last = sweep.intervals_ - 1;
    const std::size_t both = std::min(m, last - m);  // two chains at once: it hides latency
    Lanes top = Lanes::zero();
    Lanes bottom = Lanes::zero();
    for (std::size_t k = 0; k < both; ++k) {
      top = eliminate(sweep, 1 + k, top);
      bottom = eliminate(sweep, last - k, bottom);
    }
    for (std::size_t row = 1 + both; row <= m; ++row) top = eliminate(sweep, row, top);
    for (std::size_t row = last - both; row > m; --row) bottom = eliminate(sweep, row, bottom);

    const Lanes multiplier = Lanes::load(&sweep.meeting_[0]);
    bottom = bottom.minus(multiplier, top).times(Lanes::load(&sweep.meeting_[2 * V]));
    finish(sweep, m + 1, bottom);
    top = substitute(sweep, m, &sweep.meeting_[0], bottom);
    const auto above = [&sweep](std::size_t row) { return &sweep.factors_[(row + 1) * kFactors]; };
    const auto below = [&sweep](std::size_t row) { return &sweep.factors_[(row - 1) * kFactors]; };
    const std::size_t pairs = std::min(m - 1, last - m - 1);
    for (std::size_t k = 1; k <= pairs; ++k) {
      top = substitute(sweep, m - k, above(m - k), top);
      bottom = substitute(sweep, m + 1 + k, below(m + 1 + k), bottom);
    }
    for (std::size_t row = m - pairs - 1; row >= 1; --row) top = substitute(sweep, row, above(row), top);
    for (std::size_t row = m + 2 + pairs; row <= last; ++row) bottom = substitute(sweep, row, below(row), bottom);
  }
};

Sweep::Sweep(std::size_t intervals, std::size_t terms)
    : intervals_(intervals),
      terms_(terms),
      vectors_((terms + kLanes - 1) / kLanes),
      re_(intervals + 1),
      im_(intervals + 1),
      diagonal_re_(intervals + 1),
      diagonal_im_(intervals + 1),
      off_re_(intervals + 1),
      off_im_(intervals + 1),
      right_{std::vector<double>(intervals + 1), std::vector<double>(intervals + 1)},
      old_product_(right_),
      scale_(6 * vectors_),
      factors_((intervals + 1) * 4 * vectors_),
      meeting_(4 * vectors_),
      solution_((intervals + 1) * 2 * vectors_),
      valid_bottom_(intervals) {}

void Sweep::set_rational(const Rational& rational) {
  const auto set = [this](std::size_t which, std::size_t term, std::complex<double> value) {
    scale_[2 * which * vectors_ + term / kLanes][term % kLanes] = value.real();
    scale_[(2 * which + 1) * vectors_ + term / kLanes][term % kLanes] = value.imag();
  };
  for (std::size_t j = 0; j < terms_; ++j) {
    set(0, j, -1.0 / rational.pole[j]);
    set(1, j, rational.residue[j]);
    set(2, j, 1.0 / rational.residue[j]);
  }
  valid_top_ = 0;
  valid_bottom_ = intervals_;
}

namespace {

template <class Function>
void with_vectors(std::size_t vectors, const Function& function) {
  switch (vectors) {
    case 1:
      function(std::integral_constant<std::size_t, 1>{});
      break;
    case 2:
      function(std::integral_constant<std::size_t, 2>{});
      break;
    case 3:
      function(std::integral_constant<std::size_t, 3>{});
      break;
    default:
      function(std::integral_constant<std::size_t, 4>{});
      break;
  }
}

}  // namespace

void Sweep::take(const DepthOperator& depth_operator, RowRange changed, std::size_t meeting_row) {
  if (!changed.empty()) {
    if (started_) {
      multiply_by_mass(changed, old_product_);
      stepped_ = changed;
    }
    copy_mass(depth_operator.mass(), changed);
    valid_top_ = std::min(valid_top_, changed.first - 1);
    valid_bottom_ = std::max(valid_bottom_, changed.last + 1);
  }
  meeting_row_ = std::clamp<std::size_t>(meeting_row, 1, intervals_ - 2);
  valid_top_ = std::min(valid_top_, meeting_row_);
  valid_bottom_ = std::max(valid_bottom_, meeting_row_ + 1);
  with_vectors(vectors_, [&](auto v) {
    using K = Kernel<decltype(v)::value>;
    K::factorise(*this, depth_operator, valid_top_ + 1, meeting_row_ - valid_top_, 1);
    K::factorise(*this, depth_operator, valid_bottom_ - 1, valid_bottom_ - 1 - meeting_row_, -1);
    K::factorise_meeting(*this, depth_operator);
  });
  valid_top_ = meeting_row_;
  valid_bottom_ = meeting_row_ + 1;
}

void Sweep::copy_mass(const Tridiagonal& mass, RowRange rows) {
  for (std::size_t i = rows.first - 1; i <= rows.last; ++i) {
    diagonal_re_[i] = mass.diagonal[i].real();
    diagonal_im_[i] = mass.diagonal[i].imag();
    off_re_[i] = mass.off[i].real();
    off_im_[i] = mass.off[i].imag();
  }
}

void Sweep::multiply_by_mass(RowRange rows, Rows& product) const {
  const double* const ur = re_.data();
  const double* const ui = im_.data();
  const double* const dr = diagonal_re_.data();
  const double* const di = diagonal_im_.data();
  const double* const fr = off_re_.data();
  const double* const fi = off_im_.data();
  double* __restrict const pr = product.re.data();
  double* __restrict const pi = product.im.data();
#ifndef __clang__  // which has no such pragma
#pragma GCC ivdep  // the product does not overlap the field; the compiler takes restrict on a local for no promise and stays scalar
#endif
  for (std::size_t i = rows.first; i <= rows.last; ++i) {
    pr[i] = dr[i] * ur[i] - di[i] * ui[i] + fr[i - 1] * ur[i - 1] - fi[i - 1] * ui[i - 1] + fr[i] * ur[i + 1] - fi[i] * ui[i + 1];
    pi[i] = dr[i] * ui[i] + di[i] * ur[i] + fr[i - 1] * ui[i - 1] + fi[i - 1] * ur[i - 1] + fr[i] * ui[i + 1] + fi[i] * ur[i + 1];
  }
}

void Sweep::apply() {
  multiply_by_mass({1, intervals_ - 1}, right_);
  for (std::size_t i = stepped_.first; i <= stepped_.last; ++i) {
    right_.re[i] = 0.5 * (right_.re[i] + old_product_.re[i]);
    right_.im[i] = 0.5 * (right_.im[i] + old_product_.im[i]);
  }
  stepped_ = {};
  started_ = true;
  with_vectors(vectors_, [this](auto v) { Kernel<decltype(v)::value>::apply(*this); });
}

void Sweep::solutions_at(const DepthTap& tap, std::span<std::complex<double>> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t k = 0; k < tap.count; ++k) {
    const double* const re = reinterpret_cast<const double*>(&solution_[tap.node[k] * 2 * vectors_]);
    const double* const im = re + vectors_ * kLanes;
    for (std::size_t j = 0; j < terms_; ++j) y[j] += tap.weight[k] * std::complex<double>(re[j], im[j]);
  }
}

}  // namespace earshot::pe
