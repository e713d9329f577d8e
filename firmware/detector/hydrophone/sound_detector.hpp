#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/status.hpp"
#include "firmware/detector/hydrophone/detection_tracker.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/detector/hydrophone/sound_channel.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::detector {

/// From hydrophone samples to the SNR, in fixed memory, a bounded time for each block, the same bits on every machine.
///
///   samples -> two decimating FIR filters -> band-pass -> mean power over the integration time -> over the noise floor -> SNR -> threshold
///
/// A block is given, then its estimates are drawn one by one:
///
///   detector.hear(block, samples);
///   while (const std::optional<Estimate> estimate = detector.next()) ...
///
/// The blocks may be of any length; the same sound in other blocks gives the same bits, dates aside.
class SoundDetector {
 public:
  /// Forgets everything. @return kOutOfRange where check(settings) finds a fault, and then hears nothing
  [[nodiscard]] Status configure(const SoundSettings& settings);

  /// Any block at all, whatever it says. @param samples  block.samples_per_channel times block.channels, interleaved; valid until next()
  /// returns nothing. What was not drawn of the block before is passed over as missing.
  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples);

  /// The next estimate that the block completes; nothing when the block is used up.
  [[nodiscard]] std::optional<Estimate> next();

  /// At the end of the sound: the detection that is not over yet.
  [[nodiscard]] std::optional<Detection> finish();

  /// From the next block on, as at the beginning; what is known of the noise stays, and counts as settled, however little it is (four
  /// integration times at least). For a recording: hear its first `floor_window` once, call this, then hear it all.
  void begin_again_knowing_the_noise();

  /// How the vehicle moves, until it is told otherwise. May be called between any two blocks. NaN closes no gate: whoever does not know
  /// the speed gives the best guess that there is.
  void note_motion(MetersPerSecond speed, double thruster_rpm);

  /// What is wrong with the chain as the last block has it; kNone also before the first.
  [[nodiscard]] CalibrationFault calibration_fault() const { return calibration_fault_; }
  /// How the last sample rate is listened to; nothing before the first block that could be.
  [[nodiscard]] const ListeningPlan* plan() const { return has_plan_ ? &plan_ : nullptr; }

 private:
  using AllPowers = std::array<ChannelPowers, config::kHydrophoneChannels>;

  [[nodiscard]] Hearing judge(const messages::HydrophoneBlock& block, std::span<const float> samples);
  void plan_for(const messages::HydrophoneBlock& block);
  void restart(Hearing reason);
  [[nodiscard]] Estimate end_quarter();
  [[nodiscard]] std::array<double, kQuarters> estimate_snr(const AllPowers& powers, Estimate& estimate) const;
  [[nodiscard]] bool is_listened_to(std::size_t channel) const;
  [[nodiscard]] Time time_of(std::size_t consumed) const;

  SoundSettings settings_;
  ListeningPlan plan_;
  ChainLevels levels_;
  std::array<SoundChannel, config::kHydrophoneChannels> channels_;
  DetectionTracker tracker_;
  bool is_configured_ = false;
  bool has_plan_ = false;
  bool knows_the_noise_ = false;  ///< begin_again_knowing_the_noise() was called
  bool is_too_loud_ = false;      ///< the vehicle itself
  CalibrationFault calibration_fault_ = CalibrationFault::kNone;

  messages::HydrophoneBlock block_;
  std::span<const float> samples_;  ///< of the block, while it is used up
  std::size_t consumed_ = 0;        ///< of the block, samples of one channel
  bool is_impossible_ = false;      ///< the block: there is nothing to say but that
  bool has_begun_ = false;          ///< a block was heard since the beginning
  std::int64_t next_sample_ = 0;
  std::size_t fed_ = 0;         ///< samples of one channel in this quarter
  std::uint32_t quarters_ = 0;  ///< since the filters began
  Hearing began_with_ = Hearing::kFillingUp;
};

}  // namespace earshot::detector
