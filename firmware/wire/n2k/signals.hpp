#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::n2k {

// Encoding and decoding run on one table (table/messages.hpp), which says what every message on the bus looks like; the DBC file for
// candump, cantools and SavvyCAN users is printed from it (earshot dbc). Where a field is a constant, all of this is settled when it is
// compiled: there is no search by name on the way of a frame.

/// The name of a field, to find it by. A literal's key is computed when it is compiled.
struct FieldName {
  std::uint32_t key;
  consteval FieldName(const char* name) : key(key_of(name)) {}  // NOLINT(google-explicit-constructor): in a name's place
  constexpr explicit FieldName(std::string_view name) : key(key_of(name)) {}
  constexpr explicit FieldName(std::uint32_t key_of_name) : key(key_of_name) {}
};

/// What a member of a message is called on the bus: kBusName<&messages::Setpoint::speed>. Does not compile if the bus does not carry it.
template <auto... kSteps>
inline constexpr FieldName kBusName{table::signal_of<kSteps...>().key};

/// Every message Earshot reads or writes.
[[nodiscard]] std::span<const Message> messages();

/// The first with this PGN (and, of those that share it, of this kind); null if the table has no such message or signal.
[[nodiscard]] const Message* find_message(std::uint32_t pgn, std::uint8_t kind = 0);
[[nodiscard]] const Signal* find_signal(const Message& message, FieldName name);

/// The raw value that says "not available"; of a field all of whose values are numbers, the highest.
[[nodiscard]] constexpr std::int64_t not_available(const Signal& signal) {
  return signal.top();
}

/// How many of the highest raw values are no numbers.
[[nodiscard]] constexpr std::int64_t special_values(const Signal& signal) {
  return signal.special_count;
}

namespace detail {

constexpr bool fits(const Signal& signal, std::size_t size) {
  return std::size_t{signal.first_bit} + signal.bit_count <= 8 * size;
}

constexpr std::uint64_t read_bits(std::span<const std::uint8_t> bytes, const Signal& signal) {
  const std::size_t first = signal.first_bit / 8U;
  const std::size_t last = (signal.first_bit + signal.bit_count - 1U) / 8U;
  const unsigned shift = signal.first_bit % 8U;
  std::uint64_t bits = std::uint64_t{bytes[first]} >> shift;
  for (std::size_t i = first + 1; i <= last; ++i) bits |= std::uint64_t{bytes[i]} << (8U * (i - first) - shift);
  return bits & (~std::uint64_t{0} >> (64U - signal.bit_count));
}

constexpr void write_bits(std::span<std::uint8_t> bytes, const Signal& signal, std::uint64_t raw) {
  for (unsigned i = 0; i < signal.bit_count; ++i) {
    const unsigned bit = signal.first_bit + i;
    const unsigned mask = 1U << (bit % 8U);
    const unsigned cleared = bytes[bit / 8U] & ~mask;
    bytes[bit / 8U] = static_cast<std::uint8_t>(((raw >> i) & 1U) != 0 ? cleared | mask : cleared);
  }
}

}  // namespace detail

/// The whole number that stands for a field's value, exactly, however many bits it has.
/// @return kNotReady: the field says "not available". kOutOfRange: "out of range", reserved, or a value the standard does not allow.
/// kMalformed: too few bytes, or a field of text.
[[nodiscard]] constexpr Result<std::int64_t> decode_raw(const Signal& signal, std::span<const std::uint8_t> bytes) {
  if (!detail::fits(signal, bytes.size()) || signal.kind != Signal::Kind::kNumber) return Status::kMalformed;
  auto raw = static_cast<std::int64_t>(detail::read_bits(bytes, signal));
  if (signal.sign == Signal::Sign::kSigned) {
    const unsigned unused = 64U - signal.bit_count;
    raw = static_cast<std::int64_t>(static_cast<std::uint64_t>(raw) << unused) >> unused;
  }
  if (signal.special_count != 0 && raw == signal.top()) return Status::kNotReady;
  if (raw < signal.lowest_raw || raw > signal.highest_raw) return Status::kOutOfRange;
  return raw;
}

/// The failures of decode_raw().
/// Error: none below 2^53 steps (the double nearest to the decimal); beyond, two roundings of a double.
[[nodiscard]] constexpr Result<double> decode(const Signal& signal, std::span<const std::uint8_t> bytes) {
  const Result<std::int64_t> raw = decode_raw(signal, bytes);
  if (!raw.ok()) return raw.status();
  return static_cast<double>(raw.value()) * signal.scale.numerator / signal.scale.denominator;
}

/// kOutOfRange, and nothing written, unless `raw` is a number that the standard allows. kFull: too few bytes.
[[nodiscard]] Status encode_raw(const Signal& signal, std::int64_t raw, std::span<std::uint8_t> bytes);

/// Writes the nearest raw value. kOutOfRange, and nothing written, if `value` is not finite or not in [lowest, highest]. kFull: too few
/// bytes.
[[nodiscard]] Status encode(const Signal& signal, double value, std::span<std::uint8_t> bytes);

/// Bytes of a message all of whose fields are "not available" and whose reserved bits are one; the first message.size of them count.
[[nodiscard]] std::array<std::uint8_t, kMaxMessageSize> blank(const Message& message);

}  // namespace earshot::n2k
