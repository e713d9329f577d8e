#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

/// Writes one message field by field. The first refusal is remembered; fields not set stay "not available".
class MessageWriter {
 public:
  explicit MessageWriter(std::uint32_t pgn);

  MessageWriter& set(std::string_view signal, double value);

  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), message_.size}; }
  /// The message's PGN and default priority.
  [[nodiscard]] Identifier identifier(std::uint8_t source) const { return {message_.pgn, message_.priority, source, kBroadcast}; }
  /// The message as one frame; for messages of at most 8 bytes.
  [[nodiscard]] Status frame(std::uint8_t source, Frame& frame) const;

 private:
  const Message& message_;
  std::array<std::uint8_t, kMaxMessageSize> bytes_;
  Status status_ = Status::kOk;
};

/// Value of one field of a message; the failures of decode().
[[nodiscard]] Result<double> read(std::uint32_t pgn, std::string_view signal, std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
