#include "sim/spectrum/third_octaves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace earshot::spectrum {

std::vector<ThirdOctave> third_octaves(Hertz lowest, Hertz highest) {
  constexpr double kReference_hz = 1000.0;
  std::vector<ThirdOctave> bands;
  const int first = static_cast<int>(std::floor(10.0 * std::log10(lowest.value / kReference_hz)));
  for (int n = first;; ++n) {
    const double centre = kReference_hz * std::pow(10.0, n / 10.0);
    const ThirdOctave band{Hertz{centre}, Hertz{centre * std::pow(10.0, -0.05)}, Hertz{centre * std::pow(10.0, 0.05)}};
    if (!(band.high <= highest)) return bands;
    if (band.low >= lowest) bands.push_back(band);
  }
}

double power_in(std::span<const float> psd, Hertz bin_width, Hertz low, Hertz high) {
  const double first_edge = low.value / bin_width.value;
  const double last_edge = high.value / bin_width.value;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(first_edge + 0.5)));
  double power = 0.0;
  for (std::size_t k = first; k < psd.size(); ++k) {
    const double begin = std::max(first_edge, static_cast<double>(k) - 0.5);
    const double end = std::min(last_edge, static_cast<double>(k) + 0.5);
    if (!(begin < end)) break;
    power += static_cast<double>(psd[k]) * (end - begin) * bin_width.value;
  }
  return power;
}

}  // namespace earshot::spectrum
