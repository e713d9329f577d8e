#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/boards/linux/hydrophone/sample_meter.hpp"
#include "firmware/boards/linux/hydrophone/sample_sink.hpp"
#include "firmware/boards/linux/hydrophone/shared_counter.hpp"
#include "firmware/boards/linux/hydrophone/spsc_queue.hpp"
#include "firmware/boards/linux/port/heard_chain.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/host/transport/wake_event.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::board {

/// When a hydrophone wakes the loop.
enum class WakesFor : std::uint8_t {
  kMeasurements,  ///< at sea: when there is something to take
  kBlocks,        ///< in lock-step, where the loop waits until every block has been heard
};

/// What becomes of a hydrophone's samples: the listening thread keeps account of them, runs the detector and passes on what it heard; the
/// loop takes it. One measurement for each integration time, which shares no sound with the one before
/// (detector::Estimate::is_snr_measurement()).
class HydrophoneProcessor final : public SampleSink {
 public:
  /// @param settings  none: samples are counted, nothing is heard
  HydrophoneProcessor(const std::optional<detector::SoundSettings>& settings, WakesFor wakes);

  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) override;

  // For the loop's thread.
  /// Readable when there is something to take.
  [[nodiscard]] int file_descriptor() const { return wake_event_.file_descriptor(); }
  /// Before what there is is taken.
  void clear() const { wake_event_.clear(); }
  /// Dated by the blocks; false when there is none.
  [[nodiscard]] bool take(messages::SnrMeasurement& oldest) { return measurements_.take(oldest); }
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
    std::uint64_t measurements = 0;
    std::uint64_t too_faint = 0;  ///< of them
    std::uint64_t detections = 0;
    std::uint64_t left_out = 0;  ///< measurements and detections that the loop did not take in time
    /// Sound by what was in the way of hearing it.
    std::array<Duration, detector::kHearings> sound{};
  };
  [[nodiscard]] Account heard() const;

 private:
  void listen(const messages::HydrophoneBlock& block, std::span<const float> samples);
  void take(const detector::Estimate& estimate, const messages::HydrophoneBlock& block);
  void report_chain(const messages::HydrophoneBlock& block);
  void report_deafness(const detector::Estimate& estimate);
  [[nodiscard]] HeardChain chain_of(const messages::HydrophoneBlock& block) const;

  std::optional<detector::SoundSettings> settings_;
  WakesFor wakes_;
  SampleMeter meter_;
  detector::SoundDetector detector_;  ///< of the listening thread
  HeardChain reported_chain_;         ///< likewise
  bool has_reported_ = false;
  bool is_reported_deaf_ = false;  ///< likewise
  SpscQueue<messages::SnrMeasurement, config::kHydrophoneMeasurements> measurements_;
  SpscQueue<messages::SoundDetection, config::kHydrophoneDetections> detections_;
  SpscQueue<HeardChain, 4> chains_;                    ///< full: told at the next block
  SpscQueue<messages::HydrophoneStatus, 4> statuses_;  ///< full: told at the next estimate
  std::atomic<double> speed_mps_{0.0};
  std::atomic<std::uint64_t> blocks_heard_{0};
  SharedCounter measurements_heard_;
  SharedCounter measurements_too_faint_;
  SharedCounter detections_heard_;
  SharedCounter left_out_;
  std::array<SharedCounter, detector::kHearings> sound_us_;
  host::WakeEvent wake_event_;
};

}  // namespace earshot::board
