#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/hydrophone_block.hpp"
#include "sim/hydrophone/ambient_noise.hpp"
#include "sim/hydrophone/calls.hpp"
#include "sim/ocean/band.hpp"
#include "sim/search/scenario/conditions.hpp"

namespace earshot::hydrophone {

/// Noise of the vehicle's own way through the water.
///
///   level(v) = level at 2 m/s + 60 lg(v / 2 m/s)
///
/// of the same colour as the sea's. Flow noise rises by about 18 dB with every doubling of the speed.
/// Source: Urick, Principles of Underwater Sound, 3rd ed., ch. 11.   Oracle: Hydrophone.HearsItsOwnWayThroughTheWaterBesidesTheSea,
/// SelfNoise.*
struct SelfNoise {
  Decibels at_two_mps{65.0};  ///< in the detector's band, dB re 1 uPa
  [[nodiscard]] Decibels level(MetersPerSecond speed) const;
};

/// What hears and what is to be heard.
struct HydrophoneSettings {
  Hertz sample_rate{1000.0};
  Duration block = Duration::seconds(1);
  ocean::Band band{.low = Hertz{15.0}, .high = Hertz{30.0}};  ///< the detector's, in which noise has its level
  Decibels noise_level{90.0};                                 ///< of the sea in that band, dB re 1 uPa
  SelfNoise self_noise = {};
  MetersPerSecond sound_speed{1500.0};  ///< by which a call takes its time
  Calls calls = {};
  Decibels full_scale{165.0};  ///< level of a sample of 1.0, dB re 1 uPa peak
  Decibels gain = {};          ///< that a block names
  int adc_bits = 24;           ///< 2 to 24, so that a float holds every step
  double loss = 0.0;           ///< probability that a block is lost between ADC and bus, 0 to 1
};

/// How one source sounds at the vehicle.
struct Arrival {
  Meters range;
  Decibels level;       ///< received while it calls, dB re 1 uPa root mean square
  double sung_s = 0.0;  ///< the source's own time at the start
};

/// The vehicle among its sources at one instant. The same sources in the same order at every instant.
struct Situation {
  FixedVector<Arrival, search::kMaxSources> arrivals;
  MetersPerSecond speed;  ///< through the water
};

/// A hydrophone in a simulated sea: the samples of one channel, block by block. The same seed gives the same samples.
///
///   p(t) = sum of A(t) s(t - R(t)/c + t0) + noise(t),   share of full scale = p / full scale, in whole steps of the ADC
///
/// A is the received level, in line in dB between one situation and the next, R the range, in line in metres: a vehicle that moves hears
/// the Doppler shift f v / c, and nothing clicks. Nothing is allocated after construction.
/// Oracle: Hydrophone.*
class Hydrophone {
 public:
  Hydrophone(HydrophoneSettings settings, std::uint64_t seed);

  /// Where the first block begins. The same number of sources as ever after.
  void begin(const Situation& now) { last_ = now; }

  /// The sound from the last situation to this one.
  /// @param end  of the block; its first sample was taken a block earlier
  /// @return false: the block got lost; its samples are counted, and nothing is to be sent
  [[nodiscard]] bool hear(const Situation& now, Time end);

  [[nodiscard]] const messages::HydrophoneBlock& block() const { return block_; }
  /// Shares of full scale; of a lost block too.
  [[nodiscard]] std::span<const float> samples() const { return samples_; }

 private:
  void add_noise(const Situation& before, const Situation& now);
  void add_call(const Arrival& before, const Arrival& now, double begin_s);
  void quantise();

  HydrophoneSettings settings_;
  AmbientNoise noise_;
  Pcg32 losses_;
  std::vector<double> pressure_;  ///< uPa
  std::vector<float> samples_;
  messages::HydrophoneBlock block_;
  Situation last_;
  std::int64_t next_sample_ = 0;
};

}  // namespace earshot::hydrophone
