#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/hydrophone_block.hpp"
#include "sim/hydrophone/normal_deviates.hpp"

namespace earshot::hil {

/// What is between the water and the ADC.
enum class SoundLine : std::uint8_t {
  kWhole,
  kOpen,     ///< the cable is off: nothing but the mains' hum
  kShorted,  ///< nothing at all
};

/// What is wrong with a hydrophone that sends its samples.
struct SoundFault {
  SoundLine line = SoundLine::kWhole;
  Decibels gain_error = {};  ///< of the amplifier, over what its blocks name
  bool is_mute = false;      ///< its ADC goes on, and no block is sent
  friend bool operator==(const SoundFault&, const SoundFault&) = default;
};

/// A source in the noise of the sea as one channel's samples, shares of the ADC's full scale.
///
///   x(t) = A sin(2 pi 20 Hz t) + noise(t),   SNR = 10 lg((A^2 / 2) / (s^2 B / (fs / 2)))
///
/// s^2 is the variance of the noise, which is white, B the band in which it counts.
/// Oracle: HydrophoneSamples tests
class HydrophoneSamples {
 public:
  static constexpr Hertz kSource{20.0};
  static constexpr Hertz kBandWidth{4.0};  ///< 18 to 22 Hz, as the detector's preset continuous_tone has it
  static constexpr Hertz kMains{50.0};
  static constexpr double kHum = 0.01;  ///< amplitude on an open line, share of full scale
  static constexpr Hertz kSampleRate{500.0};
  static constexpr std::size_t kSamples = 125;  ///< of a block: a quarter of a second
  static constexpr Duration kBlock = Duration::milliseconds(250);
  static constexpr Decibels kNoise{-90.0};  ///< in the band, re full scale
  static constexpr int kBits = 24;

  HydrophoneSamples(Decibels snr, std::uint64_t seed);

  void disturb(const SoundFault& fault) { fault_ = fault; }
  /// The next block. @param end  when its last sample was taken   @return false: it is not sent
  [[nodiscard]] bool take(Time end);
  [[nodiscard]] const messages::HydrophoneBlock& block() const { return block_; }
  [[nodiscard]] std::span<const float> samples() const { return samples_; }

 private:
  [[nodiscard]] double next();

  double tone_;   ///< amplitude
  double noise_;  ///< root mean square of the whole
  hydrophone::NormalDeviates normal_;
  SoundFault fault_;
  std::int64_t next_sample_ = 0;
  std::vector<float> samples_ = std::vector<float>(kSamples);
  messages::HydrophoneBlock block_;
};

}  // namespace earshot::hil
