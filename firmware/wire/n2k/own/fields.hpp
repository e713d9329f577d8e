#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/dictionary/words.hpp"
#include "firmware/wire/n2k/codec.hpp"

namespace earshot::n2k {

// The fields of a message of ours in its group, by its list (firmware/messages/dictionary).

namespace detail {

/// Calls `take.template operator()<Line, kLine>()` for each line of a message.
template <messages::IsDescribed Message, class Take>
void for_each_line(Take&& take) {
  using Fields = std::remove_const_t<decltype(messages::Described<Message>::kFields)>;
  [&]<std::size_t... kLines, class... Lines>(std::index_sequence<kLines...>, messages::Types<Lines...>) {
    (take.template operator()<Lines, kLines>(), ...);
  }
  (std::make_index_sequence<Fields::kCount>{}, typename Fields::Lines{});
}

template <class Message, std::size_t kLine>
consteval messages::FieldFormat format_of() {
  return messages::line_at<kLine>(messages::Described<Message>::kFields).format;
}

/// The key of the i-th word of a line's bytes.
template <class Message, std::size_t kLine, std::size_t kWord>
consteval FieldName word_name() {
  return FieldName(format_of<Message, kLine>().bus_words.signals[kWord].key);
}

template <class Message, std::size_t kLine>
void write_words(const auto& bytes, MessageWriter& writer) {
  constexpr std::size_t kCount = format_of<Message, kLine>().bus_words.count;
  static_assert(kCount * 4 == std::tuple_size_v<std::remove_cvref_t<decltype(bytes)>>);
  [&]<std::size_t... kWords>(std::index_sequence<kWords...>) {
    const auto word = [&bytes](std::size_t at) {
      std::int64_t value = 0;
      for (std::size_t i = 0; i < 4; ++i) value |= std::int64_t{bytes[4 * at + i]} << (8 * i);
      return value;
    };
    (writer.set_raw(word_name<Message, kLine, kWords>(), word(kWords)), ...);
  }
  (std::make_index_sequence<kCount>{});
}

template <class Message, std::size_t kLine>
void read_words(MessageReader& reader, auto& bytes) {
  constexpr std::size_t kCount = format_of<Message, kLine>().bus_words.count;
  [&]<std::size_t... kWords>(std::index_sequence<kWords...>) {
    const auto put = [&bytes](std::size_t at, std::int64_t value) {
      for (std::size_t i = 0; i < 4; ++i) bytes[4 * at + i] = static_cast<std::uint8_t>(value >> (8 * i));
    };
    (put(kWords, reader.raw(word_name<Message, kLine, kWords>())), ...);
  }
  (std::make_index_sequence<kCount>{});
}

/// One number, by its type.
template <class Message, std::size_t kLine, class Value>
void write_value(const Value& value, MessageWriter& writer) {
  constexpr messages::FieldFormat kFormat = format_of<Message, kLine>();
  constexpr FieldName kName(kFormat.bus.key);
  if constexpr (std::is_floating_point_v<messages::Plain<Value>>) {
    auto number = static_cast<double>(messages::plain(value));
    if constexpr (kFormat.saturates_on_bus) {
      if (number != number) return;  // stays "not available"
      number = std::clamp(number, kFormat.bus.lowest, kFormat.bus.highest);
    }
    writer.set(kName, number);
  } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
    // A counter that is beyond its place stays at its highest.
    writer.set_raw(kName, static_cast<std::int64_t>(std::min(value, static_cast<std::uint64_t>(kFormat.bus.highest_raw))));
  } else if constexpr (std::is_same_v<Value, Time>) {
    writer.set_raw(kName, value.us);
  } else {
    writer.set_raw(kName, static_cast<std::int64_t>(value));
  }
}

/// @return false: the value is none that this build knows
template <class Value>
bool put(std::int64_t raw, Value& value) {
  if constexpr (messages::HasWords<Value>) {
    constexpr bool kMayBeUnknown = requires {
      messages::WordsOf<Value>::kMayBeUnknown;
    };
    if (!kMayBeUnknown && !messages::is_value_of<Value>(raw)) return false;
    value = static_cast<Value>(raw);
  } else if constexpr (std::is_same_v<Value, Time>) {
    value = Time{raw};
  } else {
    value = static_cast<Value>(raw);
  }
  return true;
}

template <class Message, std::size_t kLine, class Value>
bool read_value(MessageReader& reader, Value& value) {
  constexpr messages::FieldFormat kFormat = format_of<Message, kLine>();
  constexpr FieldName kName(kFormat.bus.key);
  if constexpr (std::is_floating_point_v<messages::Plain<Value>>) {
    using Plain = messages::Plain<Value>;
    if constexpr (kFormat.is_later_on_bus) {
      if (const std::optional<double> reading = reader.value_if_any(kName)) value = messages::made_of<Value>(static_cast<Plain>(*reading));
    } else {
      value = messages::made_of<Value>(static_cast<Plain>(reader.value(kName)));
    }
    return true;
  } else if constexpr (kFormat.is_later_on_bus) {
    const std::optional<std::int64_t> reading = reader.raw_if_any(kName);
    return !reading || put(*reading, value);
  } else {
    return put(reader.raw(kName), value);
  }
}

}  // namespace detail

/// Writes the fields that have a place on the bus; what is missing stays "not available".
/// @param sent  of a message that does not hold its own date
template <messages::IsDescribed Message>
void write_fields(const Message& message, Time sent, MessageWriter& writer) {
  detail::for_each_line<Message>([&]<class Line, std::size_t kLine>() {
    constexpr messages::FieldFormat kFormat = detail::format_of<Message, kLine>();
    if constexpr (kFormat.bus_words.count > 0) {
      detail::write_words<Message, kLine>(*Line::Place::in(message), writer);
    } else if constexpr (kFormat.bus.key == 0) {
      return;
    } else if constexpr (std::is_same_v<Line, messages::SentTime>) {
      writer.set_raw(FieldName(kFormat.bus.key), sent.us);
    } else if constexpr (requires { Line::kIsCount; }) {
      writer.set_raw(FieldName(kFormat.bus.key), static_cast<std::int64_t>(Line::Place::in(message)->size()));
    } else {
      if (const auto* const value = Line::value_in(message)) detail::write_value<Message, kLine>(*value, writer);
    }
  });
}

/// Reads them. What the message holds no place for (an optional part that is not there) and counts are passed over.
/// @return the reader's failure; kUnsupported: a value that this build does not know
template <messages::IsDescribed Message>
[[nodiscard]] Status read_fields(MessageReader& reader, Message& message, Time* sent = nullptr) {
  bool is_known = true;
  detail::for_each_line<Message>([&]<class Line, std::size_t kLine>() {
    constexpr messages::FieldFormat kFormat = detail::format_of<Message, kLine>();
    if constexpr (kFormat.bus_words.count > 0) {
      detail::read_words<Message, kLine>(reader, *Line::Place::in(message));
    } else if constexpr (kFormat.bus.key == 0 || requires { Line::kIsCount; }) {
      return;
    } else if constexpr (std::is_same_v<Line, messages::SentTime>) {
      const Time date{reader.raw(FieldName(kFormat.bus.key))};
      if (sent != nullptr) *sent = date;
    } else if constexpr (requires { Line::kIsOptional; }) {
      reader.take_if_any(FieldName(kFormat.bus.key),
                         [&message](double reading) { *Line::Place::in(message) = messages::made_of<typename Line::Value>(reading); });
    } else {
      if (auto* const value = Line::value_in(message)) is_known = detail::read_value<Message, kLine>(reader, *value) && is_known;
    }
  });
  if (reader.status() != Status::kOk) return reader.status();
  return is_known ? Status::kOk : Status::kUnsupported;
}

}  // namespace earshot::n2k
