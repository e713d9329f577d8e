#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::spectrum {

/// Power spectral density of sound over windows of about a second that overlap.
///
///   psd[k] = c |sum of w[i] x[i] exp(-2 pi j i k / n)|^2 / (rate * sum of w[i]^2),   c = 2 but for 0 Hz and half the rate, where it is 1
///
/// w is Hann's window, so that the sum of psd times bin_width() is the mean square of the sound.
/// Source: Welch 1967, The use of fast Fourier transform for the estimation of power spectra, IEEE Trans. Audio Electroacoust. 15.
/// Oracle: ShortTimeSpectrum.*
class ShortTimeSpectrum {
 public:
  /// @param psd  units squared per Hz, one for each bin; NaN throughout where a sample is no number
  /// @param begin  the window's first sample, as take() counts them
  using Sink = std::function<void(std::span<const float> psd, std::uint64_t begin)>;

  /// @param windows_per_length  windows that begin within the length of one, 2 at least: 2 use all sound about alike, more draw it finer
  ShortTimeSpectrum(Hertz sample_rate, std::size_t windows_per_length);
  ~ShortTimeSpectrum();
  ShortTimeSpectrum(const ShortTimeSpectrum&) = delete;
  ShortTimeSpectrum& operator=(const ShortTimeSpectrum&) = delete;

  /// @param begin  number of the first sample; where it does not follow on the last, what was not a whole window is left out
  void take(std::span<const float> samples, std::uint64_t begin, const Sink& sink);
  /// The next sample does not follow on the last, whatever its number.
  void restart() { window_.clear(); }

  [[nodiscard]] std::size_t length() const { return length_; }  ///< samples of a window: a product of 2, 3 and 5 up to the rate
  [[nodiscard]] std::size_t hop() const { return hop_; }
  [[nodiscard]] std::size_t bins() const { return length_ / 2 + 1; }
  [[nodiscard]] Hertz bin_width() const { return Hertz{sample_rate_.value / static_cast<double>(length_)}; }
  [[nodiscard]] Hertz sample_rate() const { return sample_rate_; }

 private:
  void transform();

  struct Engine;
  Hertz sample_rate_;
  std::size_t length_;
  std::size_t hop_;
  std::vector<float> weights_;
  double scale_ = 0.0;
  std::unique_ptr<Engine> engine_;
  std::vector<float> window_;  ///< samples so far
  std::uint64_t window_begin_ = 0;
  std::vector<float> psd_;
};

}  // namespace earshot::spectrum
