#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/band.hpp"

namespace earshot::ocean {

enum class Rain : std::uint8_t { kNone, kIntermediate, kModerate, kHeavy };

/// What makes the sea loud.
struct NoiseSources {
  double shipping = 0.5;        ///< density of distant shipping: 0 light, 1 heavy
  double wind_speed_mps = 5.0;  ///< >= 0
  Rain rain = Rain::kNone;
};

/// Spectral density of ambient noise after Wenz: turbulence, distant shipping, wind waves, thermal agitation and rain, summed as powers.
///
///   turbulence 17 - 30 lg f;  shipping 40 + 20 (s - 0.5) + 26 lg f - 60 lg(f + 0.03);  wind 50 + 7.5 sqrt(w) + 20 lg f - 40 lg(f + 0.4);
///   thermal -15 + 20 lg f;  f in kHz, w in m/s; rain: a table from 631 Hz to 15.8 kHz, linear in lg f, none outside
///
/// For deep water, 1 Hz to 100 kHz; the curves are means of measurements that scatter by 5 dB and more.
/// @param frequency  > 0
/// @return dB re 1 uPa^2/Hz
/// Source: Coates, Underwater Acoustic Systems (1990), as in Stojanovic, Mobile Comput. Commun. Rev. 11 (2007) 34, after Wenz, J. Acoust.
/// Soc. Am. 34 (1962) 1936; rain: Sadowski, Katz & McFadden, Ambient Noise Standards, NUSC TD 7265 (1984). Oracle:
/// Noise.WenzCurvesGiveTheValuesWorkedByHand, Noise.WenzCurvesAgreeWithTheNavysTables
[[nodiscard]] Decibels wenz_spectral_density(const NoiseSources& sources, Hertz frequency);

/// Spectral density given at some frequencies, linear in dB against the logarithm of frequency, constant beyond the first and the last.
struct NoiseTable {
  std::vector<double> frequency_hz;              ///< > 0, strictly increasing, at least one
  std::vector<double> level_db_re_1upa2_per_hz;  ///< as many
};

/// @return dB re 1 uPa^2/Hz
[[nodiscard]] Decibels spectral_density(const NoiseTable& table, Hertz frequency);

/// Level of the noise in a band, what an ideal band-pass filter lets through.
///
///   N = 10 lg (integral over the band of 10^(density / 10) df)
///
/// By the trapezoidal rule in lg f on 1000 intervals.
/// @param density  dB re 1 uPa^2/Hz
/// @return dB re 1 uPa
/// Oracle: Noise.LevelOfWhiteNoiseIsItsDensityAndTenLogBandwidth, Noise.LevelOfASlopingSpectrumIsItsIntegral
[[nodiscard]] Decibels band_level(const std::function<Decibels(Hertz)>& density, Band band);

}  // namespace earshot::ocean
