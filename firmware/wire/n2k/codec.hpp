#pragma once

#include <array>
#include <cstdint>
#include <optional>
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
  explicit MessageWriter(const Message& message) : message_(message), bytes_(blank(message)) {}
  explicit MessageWriter(std::uint32_t pgn);

  MessageWriter& set(FieldName signal, double value);
  MessageWriter& set_raw(FieldName signal, std::int64_t raw);
  MessageWriter& set_text(FieldName signal, std::string_view text);  ///< of fixed size

  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), message_.size}; }
  /// The message's PGN and default priority.
  [[nodiscard]] Identifier identifier(std::uint8_t source, std::uint8_t destination = kBroadcast) const {
    return {message_.pgn, message_.priority, source, destination};
  }
  /// The message as one frame; for messages of at most 8 bytes.
  [[nodiscard]] Status frame(std::uint8_t source, Frame& frame, std::uint8_t destination = kBroadcast) const;

 private:
  MessageWriter& remember(Status status);

  const Message& message_;
  std::array<std::uint8_t, kMaxMessageSize> bytes_;
  Status status_ = Status::kOk;
};

/// Reads one message field by field. The first failure of decode() is remembered; what is read then, and a field that fails, is zero.
class MessageReader {
 public:
  MessageReader(const Message& message, std::span<const std::uint8_t> bytes) : message_(message), bytes_(bytes) {}

  [[nodiscard]] double value(FieldName signal);
  [[nodiscard]] std::int64_t raw(FieldName signal);
  [[nodiscard]] bool yes(FieldName signal) { return raw(signal) == 1; }  ///< of a choice between No and Yes

  /// Of what may be missing: nothing where it is, or is no number; no failure of it is remembered.
  [[nodiscard]] std::optional<double> value_if_any(FieldName signal) const;
  [[nodiscard]] std::optional<std::int64_t> raw_if_any(FieldName signal) const;
  /// Likewise, but any other failure than "not available" is remembered. Calls `take(value)` if there is one.
  template <class Take>
  void take_if_any(FieldName signal, Take&& take) {
    const Result<double> decoded = decode_of(signal);
    if (decoded.ok()) take(decoded.value());
    if (status_ == Status::kOk && !decoded.ok() && decoded.status() != Status::kNotReady) status_ = decoded.status();
  }

  [[nodiscard]] Status status() const { return status_; }

 private:
  template <class T>
  [[nodiscard]] T remember(const Result<T>& result);
  [[nodiscard]] Result<double> decode_of(FieldName signal) const;

  const Message& message_;
  std::span<const std::uint8_t> bytes_;
  Status status_ = Status::kOk;
};

/// Value of one field of a message; the failures of decode().
[[nodiscard]] Result<double> read(std::uint32_t pgn, FieldName signal, std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
