#pragma once

#include <cstdint>
#include <optional>

#include "firmware/boards/linux/can/arrival.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"
#include "firmware/wire/n2k/sensors/source_gate.hpp"

namespace earshot::board {

/// What a hydrophone measures, and whether it is deaf: owns which hydrophone that is taken from, and the count of its measurements.
class SnrInput {
 public:
  SnrInput(std::uint8_t port, const n2k::SourceChoice& choice) : port_(port), gate_(choice) {}

  /// @return what is wrong with the message
  [[nodiscard]] Status take(const n2k::HeardFrame& heard, const Arrival& arrival, const n2k::Directory& directory, InputSink& sink);

  [[nodiscard]] std::uint64_t measurements() const { return measurements_; }
  /// Measurements of hydrophones that the mission does not name.
  [[nodiscard]] std::uint64_t not_chosen() const { return not_chosen_; }

 private:
  void report_hearing(const Result<bool>& deaf, bool has_snr, std::uint8_t source, const Arrival& arrival, InputSink& sink);

  std::uint8_t port_;
  n2k::SourceGate gate_;
  std::optional<std::uint8_t> deaf_address_;  ///< of the hydrophone that said last that it is deaf
  std::uint64_t measurements_ = 0;
  std::uint64_t not_chosen_ = 0;
};

}  // namespace earshot::board
