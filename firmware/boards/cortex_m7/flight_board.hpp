#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/messages/board_report.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/serial/cobs.hpp"
#include "firmware/wire/serial/record_frame.hpp"

namespace earshot::board {

/// The application of a microcontroller: what comes over its serial line goes into the runtime, samples of its hydrophone by way of the
/// detector, and what a turn says goes back. Everything that it ever needs is in it; it is all that the vehicle's RAM holds beside the
/// stack.
///
///   STARTED --> pieces of policy and tables, the mission --> ARMED (or REFUSED, and again) --> inputs, blocks of sound, turns
///
/// Channels and order: firmware/wire/serial/channels.hpp. It asks machine.hpp for the line, the clock and memory for policy and tables.
class FlightBoard {
 public:
  /// Says that it has started.
  void begin();
  /// Takes what came off the line, in pieces of any size, and answers.
  void take(std::span<const std::uint8_t> bytes);

 private:
  /// A file that comes in pieces, and where it is kept.
  struct Incoming {
    std::size_t size = 0;   ///< of the whole
    std::size_t known = 0;  ///< of these, the bytes that are there
  };

  void take(const wire::FramedRecord& record);
  void keep_piece(std::span<const std::uint8_t> piece, std::span<std::uint8_t> place, Incoming& file);
  void arm(Time time, std::span<const std::uint8_t> message);
  [[nodiscard]] Status configure(std::span<const std::uint8_t> message);
  void listen_for(Time time, std::span<const std::uint8_t> message);
  /// A block of the hydrophone at a port: each SNR measurement of it is an input, and is sent. @param record  lies in frame_, and is
  /// written over
  void hear(std::uint8_t port, const wire::FramedRecord& record);
  void report_deafness(messages::Input input, detector::Hearing hearing);
  void transmit(const messages::Input& input);
  void take(const messages::Input& input);
  void turn(Time now, std::span<const std::uint8_t> count);
  void transmit(Time now, const runtime::Outputs& outputs);
  void report(Time time, messages::BoardEvent event, Status status = Status::kOk);

  alignas(float) std::array<std::uint8_t, wire::kFrameBytes> frame_{};
  wire::CobsReader reader_{frame_};
  Incoming policy_;
  Incoming tables_;
  std::uint64_t taken_ = 0;   ///< inputs and blocks of sound that came over the line since the mission
  std::uint64_t inputs_ = 0;  ///< likewise, with what was heard in these blocks
  bool hears_ = false;
  bool is_deaf_ = false;
  std::uint32_t frames_refused_ = 0;
  std::uint32_t turn_us_ = 0;
  detector::SoundDetector detector_;
  runtime::Runtime runtime_;
};

}  // namespace earshot::board
