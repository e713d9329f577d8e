#pragma once

#include <cstdint>
#include <optional>

#include "firmware/boards/linux/can/can_device.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// What the bus hears of a mission: decisions, health, and each port's report. Owns what was told last, and when.
class StatusOutput {
 public:
  /// @param device  must outlive it
  explicit StatusOutput(CanDevice& device) : device_(device) {}

  /// A decision at once; health and reports once a period, and at once when state or steps change.
  void publish(Time now, const runtime::Outputs& outputs);

 private:
  CanDevice& device_;
  std::optional<messages::Health> published_;
  Time published_at_;
  std::uint8_t decision_sequence_ = 0;     ///< of the next one's packet
  std::uint8_t health_sequence_ = 0;       ///< likewise
  std::uint8_t port_health_sequence_ = 0;  ///< likewise
};

}  // namespace earshot::board
