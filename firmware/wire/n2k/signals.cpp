#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

namespace {

consteval bool is_well_formed(const Message& message, const Signal& signal) {
  if (signal.kind == Signal::Kind::kVariableText) return true;
  const bool inside = signal.bit_count > 0 && signal.first_bit + signal.bit_count <= 8 * message.size;
  const unsigned most = signal.sign == Signal::Sign::kSigned ? 64 : 63;
  return inside && (signal.kind == Signal::Kind::kFixedText || signal.bit_count <= most);
}

consteval bool all_are_well_formed() {
  for (const Message& message : table::kMessages) {
    if (message.size > kMaxMessageSize || (message.framing == Framing::kSingle) != (message.size <= 8)) {
      if (message.repeated_bytes == 0 && message.pgn != kConfigurationPgn) return false;
    }
    for (const Signal& signal : message.signals) {
      if (!is_well_formed(message, signal)) return false;
      for (const Signal& other : message.signals) {
        if (&other != &signal && other.key == signal.key) return false;
      }
    }
  }
  return true;
}
static_assert(all_are_well_formed(),
              "every signal lies in its message and is found by its name, every message goes the way that its size needs");

}  // namespace

std::span<const Message> messages() {
  return table::kMessages;
}

const Message* find_message(std::uint32_t pgn, std::uint8_t kind) {
  for (const Message& message : table::kMessages) {
    if (message.pgn == pgn && (kind == 0 || message.kind == kind)) return &message;
  }
  return nullptr;
}

const Signal* find_signal(const Message& message, FieldName name) {
  for (const Signal& signal : message.signals) {
    if (signal.key == name.key) return &signal;
  }
  return nullptr;
}

Status encode_raw(const Signal& signal, std::int64_t raw, std::span<std::uint8_t> bytes) {
  if (!detail::fits(signal, bytes.size())) return Status::kFull;
  if (signal.kind != Signal::Kind::kNumber || raw < signal.lowest_raw || raw > signal.highest_raw) return Status::kOutOfRange;
  detail::write_bits(bytes, signal, static_cast<std::uint64_t>(raw));
  return Status::kOk;
}

Status encode(const Signal& signal, double value, std::span<std::uint8_t> bytes) {
  if (!detail::fits(signal, bytes.size())) return Status::kFull;
  if (!(value >= signal.lowest && value <= signal.highest)) return Status::kOutOfRange;
  const double scaled = value * signal.scale.denominator / signal.scale.numerator;
  // Near the ends of 64 bits the nearest double may lie beyond the last number.
  if (scaled >= static_cast<double>(signal.highest_raw)) return encode_raw(signal, signal.highest_raw, bytes);
  if (scaled <= static_cast<double>(signal.lowest_raw)) return encode_raw(signal, signal.lowest_raw, bytes);
  return encode_raw(signal, static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5), bytes);
}

std::array<std::uint8_t, kMaxMessageSize> blank(const Message& message) {
  std::array<std::uint8_t, kMaxMessageSize> bytes{};
  bytes.fill(0xFF);
  for (const Signal& signal : message.signals) {
    if (signal.kind == Signal::Kind::kNumber) detail::write_bits(bytes, signal, static_cast<std::uint64_t>(signal.top()));
  }
  return bytes;
}

}  // namespace earshot::n2k
