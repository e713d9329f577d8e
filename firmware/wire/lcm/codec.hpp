#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/dictionary/message.hpp"

namespace earshot::wire {

// LCM's encoding of a message, made of its list (firmware/messages/dictionary): the same bytes that lcm-gen's types write and read. Nothing
// is allocated, and no number is judged: who uses a message does that.
//
//   message: u64 fingerprint, then its numbers in the order of its list, big-endian; a boolean is a byte; of an array the elements
// Source: LCM 1.3.1, lcmgen's documentation of the type language and emit_cpp.c.   Oracle: LcmCodec tests (lcm-gen's own types as the other
// side)

namespace detail {

constexpr std::int64_t mixed(std::int64_t hash, char c) {
  const auto shifted = static_cast<std::uint64_t>(hash) << 8U;
  return static_cast<std::int64_t>((shifted ^ static_cast<std::uint64_t>(hash >> 55)) + static_cast<std::uint64_t>(c));
}

constexpr std::int64_t mixed(std::int64_t hash, std::string_view text) {
  hash = mixed(hash, static_cast<char>(text.size()));
  for (const char c : text) hash = mixed(hash, c);
  return hash;
}

/// Decimal digits of an array's size, as its definition has them.
constexpr std::int64_t mixed_size(std::int64_t hash, std::size_t size) {
  std::array<char, 8> digits{};
  std::size_t count = 0;
  for (; size > 0; size /= 10) digits[count++] = static_cast<char>('0' + size % 10);
  hash = mixed(hash, static_cast<char>(count));
  while (count > 0) hash = mixed(hash, digits[--count]);
  return hash;
}

constexpr std::int64_t mixed_sizes(std::int64_t hash, const std::array<std::size_t, 2>& sizes, std::string_view counted_by = {}) {
  constexpr char kConstant = 0;
  constexpr char kVariable = 1;
  if (!counted_by.empty()) return mixed(mixed(mixed(hash, char{1}), kVariable), counted_by);
  hash = mixed(hash, static_cast<char>((sizes[0] > 0 ? 1 : 0) + (sizes[1] > 0 ? 1 : 0)));
  for (const std::size_t size : sizes) {
    if (size > 0) hash = mixed_size(mixed(hash, kConstant), size);
  }
  return hash;
}

}  // namespace detail

/// LCM's name of a type.
constexpr std::string_view lcm_name(messages::NumberType type) {
  constexpr std::array<std::string_view, 7> kNames{"int8_t", "byte", "boolean", "int32_t", "int64_t", "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

constexpr std::size_t size_of(messages::NumberType type) {
  constexpr std::array<std::size_t, 7> kSizes{1, 1, 1, 4, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

/// Bytes of all of it; none of an array that has no fixed size.
constexpr std::size_t size_of(const messages::NumberField& field) {
  if (!field.counted_by.empty()) return 0;
  std::size_t size = size_of(field.type);
  for (const std::size_t count : field.sizes) size *= count > 0 ? count : 1;
  return size;
}

/// Bytes of a message but for its fingerprint.
template <messages::IsDescribed Message>
consteval std::size_t lcm_body_size() {
  std::size_t size = 0;
  messages::for_each_line<Message>([&size](const auto& line) {
    if constexpr (requires { line.numbers(); }) {
      for (const messages::NumberField& number : line.numbers()) size += size_of(number);
    } else {
      size += line.kSize * lcm_body_size<typename std::remove_cvref_t<decltype(line)>::Element>();
    }
  });
  return size;
}

/// What tells a type from every other, and from its own of another version: made of its fields' names, types and sizes.
template <messages::IsDescribed Message>
consteval std::uint64_t lcm_fingerprint() {
  std::int64_t hash = 0x12345678;
  std::uint64_t nested = 0;
  messages::for_each_line<Message>([&](const auto& line) {
    if constexpr (requires { line.numbers(); }) {
      for (const messages::NumberField& number : line.numbers())
        hash = detail::mixed_sizes(detail::mixed(detail::mixed(hash, number.name), lcm_name(number.type)), number.sizes, number.counted_by);
    } else {
      hash = detail::mixed_sizes(detail::mixed(hash, line.name), {line.kSize, 0});
      nested += lcm_fingerprint<typename std::remove_cvref_t<decltype(line)>::Element>();
    }
  });
  return std::rotl(static_cast<std::uint64_t>(hash) + nested, 1);
}

inline constexpr std::size_t kLcmFingerprintBytes = 8;

/// Bytes of a message.
template <messages::IsDescribed Message>
inline constexpr std::size_t kLcmSize = kLcmFingerprintBytes + lcm_body_size<Message>();

namespace detail {

/// A number as it stands in a message, or back: whole instructions, where a loop over its bytes costs twice as many.
template <std::unsigned_integral Number>
Number big_endian(Number number) {
  static_assert(sizeof(Number) == 1 || sizeof(Number) == 4 || sizeof(Number) == 8);
  if constexpr (std::endian::native == std::endian::big || sizeof(Number) == 1) return number;
  if constexpr (sizeof(Number) == 4) return __builtin_bswap32(number);
  if constexpr (sizeof(Number) == 8) return __builtin_bswap64(number);
}

/// Writes big-endian numbers one behind the other; the caller has looked that there is room.
class LcmWriter {
 public:
  LcmWriter(std::uint8_t* to, Time sent) : to_(to), sent_(sent) {}

  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void number(float value) { number(std::bit_cast<std::uint32_t>(value)); }
  void number(bool value) { number(std::uint8_t{value}); }
  template <std::integral Number>
  void number(Number value) {
    const auto turned = big_endian(static_cast<std::make_unsigned_t<Number>>(value));
    std::memcpy(to_, &turned, sizeof(turned));
    to_ += sizeof(turned);
  }

  template <class Message>
  void message(const Message& message) {
    messages::for_each_line_type<Message>([&]<class Line>() {
      if constexpr (std::is_same_v<Line, messages::SentTime>) {
        number(sent_.us);
      } else {
        Line::write(message, *this);
      }
    });
  }
  template <class Message>
  void zeros() {
    std::memset(to_, 0, lcm_body_size<Message>());
    to_ += lcm_body_size<Message>();
  }

 private:
  std::uint8_t* to_;
  Time sent_;
};

/// Reads them; the caller has looked that they are there.
class LcmReader {
 public:
  explicit LcmReader(const std::uint8_t* from) : from_(from) {}

  template <class Number>
  Number number() {
    if constexpr (std::is_same_v<Number, double>) return std::bit_cast<double>(load<std::uint64_t>());
    if constexpr (std::is_same_v<Number, float>) return std::bit_cast<float>(load<std::uint32_t>());
    if constexpr (std::is_same_v<Number, bool>) return load<std::uint8_t>() != 0;
    if constexpr (std::is_integral_v<Number> && !std::is_same_v<Number, bool>)
      return static_cast<Number>(load<std::make_unsigned_t<Number>>());
  }

  /// @param message  as it is made
  template <class Message>
  void message(Message& message) {
    messages::for_each_line_type<Message>([&]<class Line>() {
      if constexpr (std::is_same_v<Line, messages::SentTime>) {
        sent = Time{number<std::int64_t>()};
      } else {
        Line::hear(*this, message);
      }
    });
    if constexpr (requires { messages::Described<Message>::derive(message); }) messages::Described<Message>::derive(message);
  }
  template <class Message>
  void pass_over() {
    from_ += lcm_body_size<Message>();
  }

  Time sent;

 private:
  template <std::unsigned_integral Number>
  Number load() {
    Number value{};
    std::memcpy(&value, from_, sizeof(value));
    from_ += sizeof(value);
    return big_endian(value);
  }

  const std::uint8_t* from_;
};

}  // namespace detail

/// @param to    kLcmSize<Message> bytes
/// @param sent  of a message that does not hold its own date
template <messages::IsDescribed Message>
void encode(const Message& message, std::span<std::uint8_t, kLcmSize<Message>> to, Time sent = {}) {
  constexpr std::uint64_t kFingerprint = lcm_fingerprint<Message>();
  detail::LcmWriter writer(to.data(), sent);
  writer.number(kFingerprint);
  writer.message(message);
}

/// kMalformed, and `message` as it was: of another type, or of a length that does not fit. Values are as they came.
/// @param sent  when it was sent, of a message that does not hold its own date
template <messages::IsDescribed Message>
[[nodiscard]] Status decode(std::span<const std::uint8_t> bytes, Message& message, Time* sent = nullptr) {
  constexpr std::uint64_t kFingerprint = lcm_fingerprint<Message>();
  if (bytes.size() != kLcmSize<Message>) return Status::kMalformed;
  detail::LcmReader reader(bytes.data());
  if (static_cast<std::uint64_t>(reader.number<std::int64_t>()) != kFingerprint) return Status::kMalformed;
  message = Message{};
  reader.message(message);
  if (sent != nullptr) *sent = reader.sent;
  return Status::kOk;
}

}  // namespace earshot::wire
