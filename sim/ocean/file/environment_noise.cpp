#include "sim/ocean/file/environment_noise.hpp"

#include <string>
#include <utility>
#include <vector>

#include "sim/ocean/noise.hpp"

namespace earshot::ocean {
namespace {

using host::Range;
using host::TableReader;

constexpr Range kFrequency_hz = {1.0, 100'000.0, Range::Lower::kAtLeast};

Band read_band(TableReader& table) {
  const std::vector<double> band = table.numbers("band_hz", kFrequency_hz);
  if (band.size() == 2 && band[1] > band[0]) return {.low = Hertz{band[0]}, .high = Hertz{band[1]}};
  if (!table.is_noted("band_hz")) table.problem("band_hz", "must be the lowest and the highest frequency of the detector's band");
  return {.low = Hertz{1.0}, .high = Hertz{2.0}};
}

NoiseSources read_wenz(TableReader& table) {
  return {.shipping = table.number("shipping", Range::between(0.0, 1.0)),
          .wind_speed_mps = table.number("wind_speed_mps", Range::between(0.0, 60.0)),
          .rain = static_cast<Rain>(table.choice_or("rain", 0, {"none", "intermediate", "moderate", "heavy"}))};
}

NoiseTable read_table(TableReader& table) {
  NoiseTable noise{.frequency_hz = table.numbers("frequency_hz", kFrequency_hz),
                   .level_db_re_1upa2_per_hz = table.numbers("level_db_re_1upa2_per_hz", Range::between(-100.0, 300.0))};
  const NoiseTable harmless{.frequency_hz = {1.0}, .level_db_re_1upa2_per_hz = {0.0}};
  if (table.is_noted("frequency_hz") || table.is_noted("level_db_re_1upa2_per_hz")) return harmless;
  bool good = !noise.frequency_hz.empty() && noise.frequency_hz.size() == noise.level_db_re_1upa2_per_hz.size();
  if (!good) table.problem("frequency_hz", "must hold one frequency or more, one for each of level_db_re_1upa2_per_hz");
  for (std::size_t i = 1; good && i < noise.frequency_hz.size(); ++i) {
    if (noise.frequency_hz[i] > noise.frequency_hz[i - 1]) continue;
    table.problem("frequency_hz", "must increase: value number " + std::to_string(i + 1) + " does not");
    good = false;
  }
  return good ? noise : harmless;
}

}  // namespace

Decibels read_noise(TableReader table) {
  switch (table.choice_or("model", 0, {"fixed", "wenz", "table"})) {
    case 1: {
      const NoiseSources sources = read_wenz(table);
      return band_level([&](Hertz f) { return wenz_spectral_density(sources, f); }, read_band(table));
    }
    case 2: {
      const NoiseTable noise = read_table(table);
      return band_level([&](Hertz f) { return spectral_density(noise, f); }, read_band(table));
    }
    default:
      return Decibels{table.number("level_db_re_1upa", Range::between(-100.0, 300.0))};
  }
}

}  // namespace earshot::ocean
