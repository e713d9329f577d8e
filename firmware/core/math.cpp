#include "firmware/core/math.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace earshot {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

/// 2^k for -1022 <= k <= 1023.
double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52U);
}

/// e^x for |x| <= 700: e^x = 2^k e^r with |r| <= ln(2)/2, e^r by its Taylor series (the first term left out is below 5e-18).
double exp_in_double(double x) {
  constexpr double kLog2E = 0x1.71547652b82fep+0;
  constexpr double kLn2High = 0x1.62e42fefp-1;  // 32 bits, so that k * high is exact
  constexpr double kLn2Low = 0x1.473de6af278edp-34;
  const int k = static_cast<int>(x * kLog2E + (x < 0.0 ? -0.5 : 0.5));
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double sum = 1.0 / 6227020800.0;
  for (const double inverse_factorial : {1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0,
                                         1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 1.0 / 2.0, 1.0, 1.0}) {
    sum = sum * r + inverse_factorial;
  }
  return sum * power_of_two(k);
}

/// ln x for a finite x > 0: x = 2^k m with m from sqrt(1/2) to sqrt(2), ln m = 2 artanh((m - 1) / (m + 1)) by its series (the first term
/// left out is below 2e-18).
double log_of_positive(double x) {
  constexpr double kLn2High = 0x1.62e42fefp-1;  // 32 bits, so that k * high is exact
  constexpr double kLn2Low = 0x1.473de6af278edp-34;
  constexpr double kSqrtHalf = 0x1.6a09e667f3bcdp-1;
  constexpr double kTwoTo54 = 0x1p54;
  const bool is_subnormal = x < std::numeric_limits<double>::min();
  const auto bits = std::bit_cast<std::uint64_t>(is_subnormal ? x * kTwoTo54 : x);
  int k = static_cast<int>(bits >> 52U) - 1022 - (is_subnormal ? 54 : 0);
  double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFU) | 0x3FE0000000000000U);  // from 1/2 to 1
  if (m < kSqrtHalf) {
    m *= 2.0;
    --k;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double sum = 1.0 / 21.0;
  for (const double coefficient :
       {1.0 / 19.0, 1.0 / 17.0, 1.0 / 15.0, 1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0}) {
    sum = sum * s2 + coefficient;
  }
  const double rest = 2.0 * s + (2.0 * s * (s2 * sum) + k * kLn2Low);
  return k * kLn2High + rest;
}

/// sin x for |x| <= pi/4, Taylor series (the first term left out is below 1e-19).
double sine_near_zero(double x) {
  const double x2 = x * x;
  double sum = 1.0 / 355687428096000.0;
  for (const double coefficient :
       {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0}) {
    sum = sum * x2 + coefficient;
  }
  return x + x * (x2 * sum);
}

/// cos x for |x| <= pi/4, Taylor series (the first term left out is below 3e-18).
double cosine_near_zero(double x) {
  const double x2 = x * x;
  double sum = 1.0 / 20922789888000.0;
  for (const double coefficient :
       {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -1.0 / 2.0, 1.0}) {
    sum = sum * x2 + coefficient;
  }
  return sum;
}

/// atan a for 0 <= a <= 1: atan a = atan c + atan((a - c) / (1 + a c)) with c the nearest eighth; the rest is at most 1/16 (series: below
/// 2e-19 left out).
double arctangent_to_one(double a) {
  static constexpr std::array<double, 9> kArctangentOfEighths = {
      0.0,
      0x1.fd5ba9aac2f6ep-4,
      0x1.f5b75f92c80ddp-3,
      0x1.6f61941e4def1p-2,
      0x1.dac670561bb4fp-2,
      0x1.1e00babdefeb4p-1,
      0x1.4978fa3269ee1p-1,
      0x1.700a7c5784634p-1,
      0x1.921fb54442d18p-1,
  };
  const int eighths = static_cast<int>(a * 8.0 + 0.5);  // NOLINT(bugprone-incorrect-roundings): any near eighth will do
  const double c = eighths * 0.125;
  const double t = (a - c) / (1.0 + a * c);
  const double t2 = t * t;
  double sum = 1.0 / 13.0;
  for (const double coefficient : {-1.0 / 11.0, 1.0 / 9.0, -1.0 / 7.0, 1.0 / 5.0, -1.0 / 3.0}) sum = sum * t2 + coefficient;
  return kArctangentOfEighths[static_cast<std::size_t>(eighths)] + (t + t * (t2 * sum));
}

/// x - n y for the whole n that brings it into [0, y); x >= 0, y > 0. Exact: x < 2 multiple always, so that no subtraction rounds.
double remainder_of(double x, double y) {
  double multiple = y;
  while (multiple <= x * 0.5) multiple *= 2.0;
  while (multiple >= y) {
    if (x >= multiple) x -= multiple;
    multiple *= 0.5;
  }
  return x;
}

}  // namespace

float exp(float x) {
  if (x != x) return x;
  if (x > 89.0F) return std::numeric_limits<float>::infinity();
  if (x < -104.0F) return 0.0F;
  return static_cast<float>(exp_in_double(double{x}));
}

double exp(double x) {
  if (x != x) return x;
  if (x > 700.0) return std::numeric_limits<double>::infinity();
  if (x < -700.0) return 0.0;
  return exp_in_double(x);
}

double log(double x) {
  if (!(x > 0.0)) return x == 0.0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (!is_finite(x)) return x;
  return log_of_positive(x);
}

double sqrt(double x) {
  return __builtin_sqrt(x);
}

Radians wrap_to_pi(Radians angle) {
  if (!is_finite(angle.value)) return Radians{std::numeric_limits<double>::quiet_NaN()};
  if (angle.value > -kPi && angle.value <= kPi) return angle;
  const double turned = remainder_of(angle.value < 0.0 ? -angle.value : angle.value, 2.0 * kPi);
  const double wrapped = turned > kPi ? turned - 2.0 * kPi : turned;
  return Radians{angle.value < 0.0 && wrapped != kPi ? -wrapped : wrapped};
}

SineCosine sine_cosine(Radians angle) {
  constexpr double kHalfPiHigh = 0x1.921fb544p+0;  // 33 bits, so that quarters * high is exact
  constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
  const double x = wrap_to_pi(angle).value;
  if (x != x) return {x, x};
  const int quarters = static_cast<int>(x * (2.0 / kPi) + (x < 0.0 ? -0.5 : 0.5));
  const double r = (x - quarters * kHalfPiHigh) - quarters * kHalfPiLow;
  const double sine = sine_near_zero(r);
  const double cosine = cosine_near_zero(r);
  switch (quarters) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case -1:
      return {-cosine, sine};
    default:
      return {-sine, -cosine};
  }
}

Radians bearing_of(double north, double east) {
  const double n = north < 0.0 ? -north : north;
  const double e = east < 0.0 ? -east : east;
  if (n == 0.0 && e == 0.0) return Radians{0.0};
  const double tangent = e <= n ? e / n : n / e;
  if (tangent != tangent) return Radians{std::numeric_limits<double>::quiet_NaN()};
  double angle = e <= n ? arctangent_to_one(tangent) : kPi / 2.0 - arctangent_to_one(tangent);
  if (north < 0.0) angle = kPi - angle;
  return Radians{east < 0.0 && angle != kPi ? -angle : angle};
}

}  // namespace earshot
