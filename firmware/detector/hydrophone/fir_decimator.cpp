#include "firmware/detector/hydrophone/fir_decimator.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/core/math.hpp"

// Sums and products below are each rounded by themselves: this file is built with -ffp-contract=off.
namespace earshot::detector {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;
constexpr double kStopBand_db = 80.0;
constexpr double kBeta = 0.1102 * (kStopBand_db - 8.7);  // Oppenheim & Schafer, eq. 7.75
using Float4 [[gnu::vector_size(16)]] = float;
constexpr std::size_t kSums = 4;  // side by side: as many as hide an addition's latency
constexpr std::size_t kLanes = kSums * 4;

/// Modified Bessel function of the first kind, order zero, by its series.
double bessel_i0(double x) {
  const double quarter = x * x / 4.0;
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; k <= 40; ++k) {
    term = term * quarter / (static_cast<double>(k) * static_cast<double>(k));
    sum = sum + term;
  }
  return sum;
}

double sinc(double x) {
  if (x == 0.0) return 1.0;
  return sine_cosine(Radians{kPi * x}).sine / (kPi * x);
}

}  // namespace

float dot(std::span<const float> taps, const float* samples) {
  assert(taps.size() % kLanes == 0);
  Float4 sums[kSums] = {};
  for (std::size_t i = 0; i < taps.size(); i += kLanes) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < kSums; ++k) {
      Float4 t;
      Float4 s;
      __builtin_memcpy(&t, taps.data() + i + 4 * k, sizeof t);
      __builtin_memcpy(&s, samples + i + 4 * k, sizeof s);
      sums[k] += t * s;
    }
  }
  const Float4 sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

std::size_t design_fir(Hertz input_rate, std::size_t factor, Hertz pass, FirDesign& design) {
  design.factor = factor;
  design.tap_count = 0;
  design.delay = 0.0;
  if (factor == 1) return 0;
  const double output_rate = input_rate.value / static_cast<double>(factor);
  const double transition = 2.0 * kPi * (output_rate - 2.0 * pass.value) / input_rate.value;
  const auto order = static_cast<std::size_t>((kStopBand_db - 8.0) / (2.285 * transition)) + 1;  // eq. 7.76
  const std::size_t length = order + 1 + order % 2;                                              // odd: a whole delay
  const std::size_t padded = (length + kLanes - 1) / kLanes * kLanes;
  if (padded > design.taps.size()) return padded;
  const double middle = static_cast<double>(length - 1) / 2.0;
  const double norm = bessel_i0(kBeta);
  double sum = 0.0;
  const auto tap = [&](std::size_t i) {
    const double from_middle = static_cast<double>(i) - middle;
    const double share = from_middle / middle;
    return sinc(from_middle * output_rate / input_rate.value) * bessel_i0(kBeta * sqrt(1.0 - share * share)) / norm;
  };
  for (std::size_t i = 0; i < length; ++i) sum = sum + tap(i);
  std::fill(design.taps.begin(), design.taps.end(), 0.0F);
  for (std::size_t i = 0; i < length; ++i) design.taps[padded - length + i] = static_cast<float>(tap(i) / sum);
  design.tap_count = padded;
  design.delay = middle;
  return padded;
}

}  // namespace earshot::detector
