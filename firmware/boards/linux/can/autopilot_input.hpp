#pragma once

#include <cstdint>

#include "firmware/boards/linux/can/arrival.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"
#include "firmware/wire/n2k/sensors/source_gate.hpp"

namespace earshot::board {

/// Whether the autopilot follows set-points: owns which autopilot says so, and the count of its statuses.
class AutopilotInput {
 public:
  AutopilotInput(std::uint8_t port, const n2k::SourceChoice& choice) : port_(port), gate_(choice) {}

  /// @return what is wrong with the message
  [[nodiscard]] Status take(const n2k::HeardFrame& heard, const Arrival& arrival, const n2k::Directory& directory, InputSink& sink);

  [[nodiscard]] std::uint64_t statuses() const { return statuses_; }

 private:
  std::uint8_t port_;
  n2k::SourceGate gate_;
  std::uint64_t statuses_ = 0;
};

}  // namespace earshot::board
