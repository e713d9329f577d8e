#include "firmware/detector/hydrophone/band_pass.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

// Sums and products below are each rounded by themselves: this file is built with -ffp-contract=off.
namespace earshot::detector {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

struct Complex {
  double re = 0.0;
  double im = 0.0;
};
Complex operator+(Complex a, Complex b) {
  return {a.re + b.re, a.im + b.im};
}
Complex operator-(Complex a, Complex b) {
  return {a.re - b.re, a.im - b.im};
}
Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator/(Complex a, Complex b) {
  const double size = b.re * b.re + b.im * b.im;
  return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}
double absolute(Complex a) {
  return sqrt(a.re * a.re + a.im * a.im);
}
/// Principal root: real part not negative.
Complex root(Complex a) {
  const double size = absolute(a);
  const double re = sqrt((size + a.re) / 2.0 > 0.0 ? (size + a.re) / 2.0 : 0.0);
  const double im = sqrt((size - a.re) / 2.0 > 0.0 ? (size - a.re) / 2.0 : 0.0);
  return {re, a.im < 0.0 ? -im : im};
}

/// Poles of the Chebyshev low-pass of order 8 with 0.05 dB of ripple that ends at 1 rad/s, those above the real axis: scipy 1.10.1,
/// scipy.signal.cheb1ap(8, 0.05). The softest first.
constexpr std::array<Complex, kSections / 2> kPrototype{{{-0.3666809802587556, 0.20827888855190646},
                                                         {-0.31085712498572343, 0.5931280929265179},
                                                         {-0.20770809036046997, 0.8876789218726185},
                                                         {-0.07293738185636275, 1.0470886817930776}}};
/// Its noise band over its ripple's, its gain in the middle of the ripple taken as one: scipy.integrate.quad over its response. The
/// band-pass transformation keeps the ratio: at equal gain two frequencies w - w0^2 / w = +-B W lie B W apart.
constexpr double kNoiseOverRipple = 1.0744932469534834;
/// A Chebyshev filter of even order is at the bottom of its ripple in the band's middle: half the ripple below its mean, 10^(-0.025/20).
constexpr double kMiddleGain = 0.99712595;

/// tan(pi f / rate): a frequency before the bilinear transformation s = (z - 1) / (z + 1).
double warped(double frequency, double rate) {
  const SineCosine angle = sine_cosine(Radians{kPi * frequency / rate});
  return angle.sine / angle.cosine;
}

/// Size of (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2) where z^-1 is `delay`.
double size_at(Complex delay, double a1, double a2) {
  const Complex delay2 = delay * delay;
  const Complex one{1.0, 0.0};
  return absolute((one - delay2) / (one + Complex{a1, 0.0} * delay + Complex{a2, 0.0} * delay2));
}

/// The section of a pole of the analog filter and its mirror image, its gain one where z^-1 is `middle`.
Section section_of(Complex pole, Complex middle) {
  const Complex one{1.0, 0.0};
  const Complex z = (one + pole) / (one - pole);
  const double a1 = -2.0 * z.re;
  const double a2 = z.re * z.re + z.im * z.im;
  return {.gain = static_cast<float>(1.0 / size_at(middle, a1, a2)), .a1 = static_cast<float>(a1), .a2 = static_cast<float>(a2)};
}

/// Impulses are followed for so many samples: ten times the decay of the narrowest band that settings may have.
constexpr std::size_t kLongestResponse = 2048;

double autocorrelation(std::span<const float> response, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = lag; i < response.size(); ++i) {
    const double a = response[i];
    const double b = response[i - lag];
    sum = sum + a * b;
  }
  return sum;
}

}  // namespace

BandPassDesign design_band_pass(Band band, Hertz rate) {
  const double ripple_half = band.width().value / kNoiseOverRipple / 2.0;
  const double centre = sqrt(band.low.value * band.high.value + ripple_half * ripple_half);
  const double low = warped(centre - ripple_half, rate.value);
  const double high = warped(centre + ripple_half, rate.value);
  const double width = high - low;
  const double middle2 = low * high;
  // z^-1 at the middle: (1 - s) / (1 + s) with s = j sqrt(low high).
  const Complex s{0.0, sqrt(middle2)};
  const Complex middle = (Complex{1.0, 0.0} - s) / (Complex{1.0, 0.0} + s);
  BandPassDesign design;
  for (std::size_t i = 0; i < kPrototype.size(); ++i) {
    const Complex half = Complex{width / 2.0, 0.0} * kPrototype[i];
    const Complex offset = root(half * half - Complex{middle2, 0.0});
    design[2 * i] = section_of(half + offset, middle);
    design[2 * i + 1] = section_of(half - offset, middle);
  }
  design[0].gain = static_cast<float>(double{design[0].gain} * kMiddleGain);
  return design;
}

void BandPass::run(const BandPassDesign& design, std::span<float> samples) {
  for (float& sample : samples) {
    float x = sample;
    for (std::size_t i = 0; i < kSections; ++i) {
      const Section& section = design[i];
      const float in = section.gain * x;
      const float out = in + state_[i].first;
      state_[i].first = state_[i].second - section.a1 * out;
      state_[i].second = -in - section.a2 * out;
      x = out;
    }
    sample = x;
  }
}

BandPassResponse measure(const BandPassDesign& design, Hertz rate, std::size_t count) {
  std::array<float, kLongestResponse> response{};
  response[0] = 1.0F;
  BandPass filter;
  filter.run(design, response);
  const double energy = autocorrelation(response, 0);
  BandPassResponse measured{.noise_width_hz = energy * rate.value / 2.0};
  double moment = 0.0;
  double tail = 0.0;
  std::size_t end = 1;
  for (std::size_t i = response.size(); i-- > 0;) {
    const double square = double{response[i]} * double{response[i]};
    tail = tail + square;
    moment = moment + static_cast<double>(i) * square;
    if (end == 1 && tail > 1e-4 * energy) end = i + 1;
  }
  measured.delay = moment / energy;
  measured.settling = static_cast<double>(end);
  const std::span<const float> heard = std::span(response).first(std::min(response.size(), 2 * end));
  const auto n = static_cast<double>(count);
  double sum = n * energy * energy;
  for (std::size_t lag = 1; lag < std::min(count, heard.size()); ++lag) {
    const double r = autocorrelation(heard, lag);
    sum = sum + 2.0 * (n - static_cast<double>(lag)) * (r * r);
  }
  measured.degrees_of_freedom = n * n * energy * energy / sum;
  return measured;
}

}  // namespace earshot::detector
