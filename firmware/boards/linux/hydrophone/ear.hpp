#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "firmware/boards/linux/hydrophone/sample_listener.hpp"
#include "firmware/boards/linux/hydrophone/sample_meter.hpp"
#include "firmware/host/transport/doorbell.hpp"

namespace earshot::board {

/// When a hydrophone wakes the loop.
enum class WakesFor : std::uint8_t {
  kLooks,   ///< at sea: when there is something to take
  kBlocks,  ///< in lock-step, where the loop waits until every block has been heard
};

/// What becomes of a hydrophone's samples: the listening thread keeps account of them; the loop takes what comes of it.
class Ear final : public SampleListener {
 public:
  explicit Ear(WakesFor wakes) : wakes_(wakes) {}

  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) override;

  // For the loop's thread.
  /// Readable when there is something to take.
  [[nodiscard]] int file_descriptor() const { return bell_.file_descriptor(); }
  /// Before what there is is taken.
  void answer() const { bell_.answer(); }
  [[nodiscard]] std::uint64_t blocks_heard() const { return blocks_heard_.load(std::memory_order_acquire); }
  [[nodiscard]] SampleMeter::Reading account() const { return meter_.read(); }

 private:
  WakesFor wakes_;
  SampleMeter meter_;
  std::atomic<std::uint64_t> blocks_heard_{0};
  host::Doorbell bell_;
};

}  // namespace earshot::board
