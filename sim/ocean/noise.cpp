#include "sim/ocean/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace earshot::ocean {
namespace {

double power(double level_db) {
  return std::pow(10.0, level_db / 10.0);
}

/// Linear between points in x; the first and last y beyond them.
double interpolated(std::span<const double> x, std::span<const double> y, double at) {
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  if (above == 0) return y.front();
  if (above == x.size()) return y.back();
  return std::lerp(y[above - 1], y[above], (at - x[above - 1]) / (x[above] - x[above - 1]));
}

// NUSC TD 7265: every tenth of a decade from 10^2.8 Hz to 10^4.2 Hz.
constexpr std::size_t kRainPoints = 15;
constexpr double kRainFirstDecade = 2.8;
constexpr std::array<std::array<double, kRainPoints>, 3> kRain_db = {{
    {79.8, 79.6, 78.6, 77.5, 76.3, 74.9, 73.6, 72.1, 70.5, 68.7, 66.9, 64.9, 62.8, 60.7, 58.6},
    {80.9, 80.9, 80.9, 80.8, 80.5, 80.0, 79.5, 78.7, 77.8, 76.8, 75.6, 74.3, 72.7, 71.1, 69.4},
    {82.1, 82.1, 82.0, 81.9, 81.9, 81.8, 81.8, 81.6, 81.4, 81.1, 80.6, 79.9, 79.0, 78.0, 76.7},
}};

double rain_power(Rain rain, Hertz frequency) {
  const double tenths = (std::log10(frequency.value) - kRainFirstDecade) * 10.0;
  if (rain == Rain::kNone || tenths < 0.0 || tenths > static_cast<double>(kRainPoints - 1)) return 0.0;
  const auto& level = kRain_db[static_cast<std::size_t>(rain) - 1];
  const std::size_t i = std::min(static_cast<std::size_t>(tenths), kRainPoints - 2);
  return power(std::lerp(level[i], level[i + 1], tenths - static_cast<double>(i)));
}

}  // namespace

Decibels wenz_spectral_density(const NoiseSources& sources, Hertz frequency) {
  const double f = frequency.value / 1000.0;
  const double lg_f = std::log10(f);
  const double turbulence = 17.0 - 30.0 * lg_f;
  const double shipping = 40.0 + 20.0 * (sources.shipping - 0.5) + 26.0 * lg_f - 60.0 * std::log10(f + 0.03);
  const double wind = 50.0 + 7.5 * std::sqrt(sources.wind_speed_mps) + 20.0 * lg_f - 40.0 * std::log10(f + 0.4);
  const double thermal = -15.0 + 20.0 * lg_f;
  return Decibels{10.0 *
                  std::log10(power(turbulence) + power(shipping) + power(wind) + power(thermal) + rain_power(sources.rain, frequency))};
}

Decibels spectral_density(const NoiseTable& table, Hertz frequency) {
  std::vector<double> lg_f(table.frequency_hz.size());
  std::transform(table.frequency_hz.begin(), table.frequency_hz.end(), lg_f.begin(), [](double f) { return std::log10(f); });
  return Decibels{interpolated(lg_f, table.level_db_re_1upa2_per_hz, std::log10(frequency.value))};
}

Decibels band_level(const std::function<Decibels(Hertz)>& density, Band band) {
  constexpr int kIntervals = 1000;
  const double width = std::log(band.high / band.low) / kIntervals;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const Hertz f = band.low * std::exp(i * width);
    sum += (i == 0 || i == kIntervals ? 0.5 : 1.0) * power(density(f).value) * f.value;  // df = f d(ln f)
  }
  return Decibels{10.0 * std::log10(sum * width)};
}

}  // namespace earshot::ocean
