#include "tests/oracles/ram/ram.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <complex>

namespace earshot::oracle {

namespace {

using Complex = std::complex<double>;
using Wide = std::complex<long double>;
constexpr double kPi = M_PI;

struct Factors {
  std::vector<Complex> numerator, denominator;  // prod (1 + numerator_j X) / (1 + denominator_j X)
};

/// Taylor coefficients of exp(i s (sqrt(1 + x) - 1)) (1 + x)^alpha (1 - x)^(2 nu) from its logarithmic derivative.
std::vector<Wide> taylor(long double s, long double alpha, int nu, int count) {
  std::vector<Wide> log_derivative;
  long double root = 0.5L;  // of (1 + x)^(-1/2) / 2
  for (int i = 0; i < count; ++i) {
    const long double sign = i % 2 == 0 ? 1.0L : -1.0L;
    log_derivative.push_back(Wide(alpha * sign - 2.0L * nu, s * root));
    root *= -(0.5L + i) / (i + 1.0L);
  }
  std::vector<Wide> f{1.0L};
  for (int i = 0; i + 1 < count; ++i) {
    Wide sum = 0.0L;
    for (int j = 0; j <= i; ++j) sum += log_derivative[static_cast<std::size_t>(j)] * f[static_cast<std::size_t>(i - j)];
    f.push_back(sum / (i + 1.0L));
  }
  return f;
}

std::vector<Complex> inverse_roots(const Eigen::Matrix<Wide, Eigen::Dynamic, 1>& coefficient) {  // of 1 + c_1 x + ... + c_n x^n
  const Eigen::Index n = coefficient.size();
  Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic> companion = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) companion(0, i) = -coefficient(i);
  for (Eigen::Index i = 1; i < n; ++i) companion(i, i - 1) = 1.0L;
  const auto eigenvalues = Eigen::ComplexEigenSolver<decltype(companion)>(companion, false).eigenvalues().eval();
  std::vector<Complex> result;
  for (const Wide value : eigenvalues) result.emplace_back(static_cast<double>(-value.real()), static_cast<double>(-value.imag()));
  return result;
}

/// numerator = f denominator to order 2n - 1, and the numerator zero at x = -3: one stability constraint in place of the highest order.
Factors pade(long double s, long double alpha, int nu, int n) {
  const auto f = taylor(s, alpha, nu, 2 * n + 1);
  Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic> a = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>::Zero(2 * n, 2 * n);
  Eigen::Matrix<Wide, Eigen::Dynamic, 1> b(2 * n);
  for (int order = 1; order < 2 * n; ++order) {
    b(order - 1) = f[static_cast<std::size_t>(order)];
    if (order <= n) a(order - 1, order - 1) = 1.0L;
    for (int j = 1; j <= std::min(order, n); ++j) a(order - 1, n + j - 1) = -f[static_cast<std::size_t>(order - j)];
  }
  b(2 * n - 1) = -1.0L;
  for (int j = 1; j <= n; ++j) a(2 * n - 1, j - 1) = std::pow(-3.0L, static_cast<long double>(j));
  const Eigen::Matrix<Wide, Eigen::Dynamic, 1> c = a.partialPivLu().solve(b);
  return {inverse_roots(c.head(n)), inverse_roots(c.tail(n))};
}

struct Grid {
  double k0, dz;
  std::size_t n;  // nodes 0 to n + 1
  std::vector<Complex> k2_water, k2_sediment;
  std::vector<double> alpha_water, alpha_sediment;
};

struct Column {
  std::vector<double> f1, f2, f3;
  std::vector<Complex> k2;
};

Column column_at(const RamCase& c, const Grid& g, double range_m) {
  const auto floor = static_cast<std::size_t>(c.floor_depth_m(range_m) / g.dz);  // the last node in the water
  Column column;
  for (std::size_t i = 0; i <= g.n + 1; ++i) {
    const bool water = i <= floor;
    column.f1.push_back(water ? 1.0 / g.alpha_water[i] : c.sediment_density / g.alpha_sediment[i]);
    column.f2.push_back(water ? 1.0 : 1.0 / c.sediment_density);
    column.f3.push_back(water ? g.alpha_water[i] : g.alpha_sediment[i]);
    column.k2.push_back(water ? g.k2_water[i] : g.k2_sediment[i]);
  }
  return column;
}

/// u <- (1 + denominator X)^-1 (1 + numerator X) u by Galerkin's tridiagonal matrices and Thomas elimination.
void apply(const Grid& g, const Column& m, Complex numerator, Complex denominator, std::vector<Complex>& u) {
  std::vector<Complex> right(g.n + 2), upper(g.n + 2);
  const double k2 = g.k0 * g.k0;
  const double stiffness = 0.5 / (g.dz * g.dz);
  Complex above = 0.0;
  for (std::size_t i = 1; i <= g.n; ++i) {
    const Complex d1 = stiffness * m.f1[i] * (m.f2[i - 1] + m.f2[i]) * m.f3[i - 1] + (m.k2[i - 1] + m.k2[i]) / 12.0;
    const Complex d2 =
        -stiffness * m.f1[i] * (m.f2[i - 1] + 2.0 * m.f2[i] + m.f2[i + 1]) * m.f3[i] + (m.k2[i - 1] + 6.0 * m.k2[i] + m.k2[i + 1]) / 12.0;
    const Complex d3 = stiffness * m.f1[i] * (m.f2[i] + m.f2[i + 1]) * m.f3[i + 1] + (m.k2[i] + m.k2[i + 1]) / 12.0;
    const Complex s =
        (k2 / 6.0 + numerator * d1) * u[i - 1] + (2.0 * k2 / 3.0 + numerator * d2) * u[i] + (k2 / 6.0 + numerator * d3) * u[i + 1];
    const Complex lower = k2 / 6.0 + denominator * d1;
    const Complex pivot = 2.0 * k2 / 3.0 + denominator * d2 - lower * upper[i - 1];
    upper[i] = (k2 / 6.0 + denominator * d3) / pivot;
    right[i] = above = (s - lower * above) / pivot;
  }
  for (std::size_t i = g.n; i >= 1; --i) u[i] = right[i] - upper[i] * u[i + 1];
}

Grid make_grid(const RamCase& c) {
  constexpr double kReference = 1500.0;
  const double omega = 2.0 * kPi * c.frequency_hz;
  const double layer = 20.0 * kReference / c.frequency_hz;
  Grid g{omega / kReference, c.depth_step_m, static_cast<std::size_t>((c.deepest_m + layer) / c.depth_step_m) - 1, {}, {}, {}, {}};
  for (std::size_t i = 0; i <= g.n + 1; ++i) {
    const double z = static_cast<double>(i) * g.dz;
    const double into = std::max(0.0, (z - c.deepest_m - 0.75 * layer) / (0.25 * layer));
    const double loss = c.sediment_attenuation_db_per_wavelength + std::min(1.0, into) * (10.0 - c.sediment_attenuation_db_per_wavelength);
    const double speed = c.water_sound_speed_mps(std::min(z, c.deepest_m));
    const Complex k = omega / c.sediment_sound_speed_mps * Complex(1.0, loss / (40.0 * kPi * std::log10(std::exp(1.0))));
    g.k2_water.emplace_back(omega * omega / (speed * speed) - g.k0 * g.k0);
    g.k2_sediment.push_back(k * k - g.k0 * g.k0);
    g.alpha_water.push_back(std::sqrt(speed / kReference));
    g.alpha_sediment.push_back(std::sqrt(c.sediment_density * c.sediment_sound_speed_mps / kReference));
  }
  return g;
}

}  // namespace

std::vector<double> ram_transmission_loss_db(const RamCase& c) {
  const Grid g = make_grid(c);
  Column column = column_at(c, g, 0.0);
  std::vector<Complex> u(g.n + 2);
  const auto source = static_cast<std::size_t>(c.source_depth_m / g.dz);
  const double offset = c.source_depth_m / g.dz - static_cast<double>(source);
  const double strength = std::sqrt(2.0 * kPi / g.k0) / (g.dz * g.alpha_water[source]);
  u[source] = (1.0 - offset) * strength;
  u[source + 1] = offset * strength;
  for (int i = 0; i < 2; ++i) apply(g, column, 0.0, -1.0, u);
  const Factors starter = pade(static_cast<long double>(g.k0 * c.range_step_m), -0.25L, 1, c.terms);
  const Factors step = pade(static_cast<long double>(g.k0 * c.range_step_m), 0.0L, 0, c.terms);
  const auto advance = [&](const Factors& f) {
    for (std::size_t j = 0; j < f.numerator.size(); ++j) apply(g, column, f.numerator[j], f.denominator[j], u);
  };
  advance(starter);
  std::vector<double> loss;
  const auto receiver = static_cast<std::size_t>(c.receiver_depth_m / g.dz);
  const double share = c.receiver_depth_m / g.dz - static_cast<double>(receiver);
  for (double range = c.range_step_m;; range += c.range_step_m) {
    const Complex p = (1.0 - share) * column.f3[receiver] * u[receiver] + share * column.f3[receiver + 1] * u[receiver + 1];
    loss.push_back(-20.0 * std::log10(std::abs(p)) + 10.0 * std::log10(range));
    if (range + 0.5 * c.range_step_m > c.max_range_m) return loss;
    column = column_at(c, g, range + 0.5 * c.range_step_m);
    advance(step);
  }
}

}  // namespace earshot::oracle
