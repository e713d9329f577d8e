#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/boards/linux/hydrophone/hand_over.hpp"
#include "firmware/boards/linux/hydrophone/sample_listener.hpp"
#include "firmware/boards/linux/hydrophone/sample_meter.hpp"
#include "firmware/boards/linux/hydrophone/shared_counter.hpp"
#include "firmware/boards/linux/port/heard_chain.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/host/transport/doorbell.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::board {

/// When a hydrophone wakes the loop.
enum class WakesFor : std::uint8_t {
  kLooks,   ///< at sea: when there is something to take
  kBlocks,  ///< in lock-step, where the loop waits until every block has been heard
};

/// What becomes of a hydrophone's samples: the listening thread keeps account of them, runs the detector and hands over what it heard; the
/// loop takes it. One look for each integration time, which shares no sound with the one before (detector::Estimate::is_look()).
class Ear final : public SampleListener {
 public:
  /// @param settings  none: samples are counted, nothing is heard
  Ear(const std::optional<detector::SoundSettings>& settings, WakesFor wakes);

  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) override;

  // For the loop's thread.
  /// Readable when there is something to take.
  [[nodiscard]] int file_descriptor() const { return bell_.file_descriptor(); }
  /// Before what there is is taken.
  void answer() const { bell_.answer(); }
  /// Dated by the blocks; false when there is none.
  [[nodiscard]] bool take(messages::SnrMeasurement& oldest) { return looks_.take(oldest); }
  [[nodiscard]] bool take(messages::SoundDetection& oldest) { return detections_.take(oldest); }
  [[nodiscard]] bool take(HeardChain& oldest) { return chains_.take(oldest); }
  /// That the hydrophone is deaf, and then that it is no longer; bears no date.
  [[nodiscard]] bool take(messages::HydrophoneStatus& oldest) { return statuses_.take(oldest); }
  /// From the next block on.
  void note_speed(MetersPerSecond speed) { speed_mps_.store(speed.value, std::memory_order_relaxed); }

  // For any thread.
  [[nodiscard]] std::uint64_t blocks_heard() const { return blocks_heard_.load(std::memory_order_acquire); }
  [[nodiscard]] SampleMeter::Reading account() const { return meter_.read(); }
  struct Account {
    std::uint64_t looks = 0;
    std::uint64_t too_faint = 0;  ///< of them
    std::uint64_t detections = 0;
    std::uint64_t left_out = 0;  ///< looks and detections that the loop did not take in time
    /// Sound by what was in the way of hearing it.
    std::array<Duration, detector::kHearings> sound{};
  };
  [[nodiscard]] Account heard() const;

 private:
  void listen(const messages::HydrophoneBlock& block, std::span<const float> samples);
  void take(const detector::Estimate& estimate, const messages::HydrophoneBlock& block);
  void tell_chain(const messages::HydrophoneBlock& block);
  void tell_deafness(const detector::Estimate& estimate);
  [[nodiscard]] HeardChain chain_of(const messages::HydrophoneBlock& block) const;

  std::optional<detector::SoundSettings> settings_;
  WakesFor wakes_;
  SampleMeter meter_;
  detector::SoundDetector detector_;  ///< of the listening thread
  HeardChain told_;                   ///< likewise
  bool has_told_ = false;
  bool is_told_deaf_ = false;  ///< likewise
  HandOver<messages::SnrMeasurement, config::kHydrophoneLooks> looks_;
  HandOver<messages::SoundDetection, config::kHydrophoneDetections> detections_;
  HandOver<HeardChain, 4> chains_;                    ///< full: told at the next block
  HandOver<messages::HydrophoneStatus, 4> statuses_;  ///< full: told at the next estimate
  std::atomic<double> speed_mps_{0.0};
  std::atomic<std::uint64_t> blocks_heard_{0};
  SharedCounter looks_heard_;
  SharedCounter looks_too_faint_;
  SharedCounter detections_heard_;
  SharedCounter left_out_;
  std::array<SharedCounter, detector::kHearings> sound_us_;
  host::Doorbell bell_;
};

}  // namespace earshot::board
