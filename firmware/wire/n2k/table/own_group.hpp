#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/dictionary/words.hpp"
#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Earshot's own groups, made of the lists of its messages (firmware/messages/dictionary): a head, and the fields that name a place on the
// bus. A group of one message has all of them (group_of); a frame that is put together of several, or has signals of its own besides, names
// each (signal_of).

/// The names of all values of an enum.
template <messages::HasWords Enum>
consteval auto choices_of() {
  constexpr const auto& kTable = messages::WordsOf<Enum>::kTable;
  return []<std::size_t... kRows>(std::index_sequence<kRows...>) {
    return std::array<Choice, kTable.size()>{Choice{static_cast<std::int64_t>(kTable[kRows].value), kTable[kRows].name}...};
  }
  (std::make_index_sequence<kTable.size()>{});
}
template <messages::HasWords Enum>
inline constexpr std::array<Choice, messages::WordsOf<Enum>::kTable.size()> kChoicesOf = choices_of<Enum>();

/// A field's place with the names of its values: its own, or those of its type.
template <class Line>
constexpr Signal named(const Line& line) {
  Signal signal = line.format.bus;
  if (!signal.choices.empty()) return signal;
  if constexpr (requires { typename Line::Value; }) {
    using Value = typename Line::Value;
    if constexpr (std::is_same_v<Value, bool>) {
      signal.choices = std::span<const Choice>(kYesNo);
    } else if constexpr (messages::HasWords<Value>) {
      signal.choices = std::span<const Choice>(kChoicesOf<Value>);
    }
  }
  return signal;
}

template <messages::IsDescribed Message>
consteval std::size_t signal_count() {
  std::size_t count = 0;
  messages::for_each_line<Message>(
      [&count](const auto& line) { count += line.format.bus_words.count + (line.format.bus.key != 0 ? 1 : 0); });
  return count;
}

/// The signals of a group, its head's and those of the message, in the order of their bits.
template <messages::IsDescribed Message, std::size_t kHead>
consteval std::array<Signal, kHead + signal_count<Message>()> group_of(const Signal (&head)[kHead]) {
  std::array<Signal, kHead + signal_count<Message>()> signals{};
  std::size_t at = 0;
  for (const Signal& signal : head) signals[at++] = signal;
  messages::for_each_line<Message>([&](const auto& line) {
    if (line.format.bus.key != 0) signals[at++] = named(line);
    for (std::size_t i = 0; i < line.format.bus_words.count; ++i) signals[at++] = line.format.bus_words.signals[i];
  });
  std::ranges::sort(signals, {}, &Signal::first_bit);
  return signals;
}

namespace detail {
template <class Message, class Value>
Message owner_of(Value Message::*);
}  // namespace detail

/// Of a group that carries some fields of a message, or of several: one of them. Does not compile if the message has no line for that
/// member, or the line no place on the bus.
///
///   signal_of<&messages::Setpoint::speed>()
template <auto kFirst, auto... kRest>
consteval Signal signal_of() {
  using Message = decltype(detail::owner_of(kFirst));
  Signal signal;
  messages::for_each_line<Message>([&signal]<class Line>(const Line& line) {
    if constexpr (requires { typename Line::Place; }) {
      if constexpr (std::is_same_v<typename Line::Place, messages::At<kFirst, kRest...>>) signal = named(line);
    }
  });
  if (signal.key == 0) there_is_no_such_name();
  return signal;
}

/// Whether these signals have each field of a message that has a place on the bus.
template <messages::IsDescribed Message>
consteval bool carry_all_of(std::span<const Signal> group, std::span<const Signal> second_group = {}) {
  bool do_carry = true;
  messages::for_each_line<Message>([&](const auto& line) {
    const std::uint32_t key = line.format.bus.key;
    const auto has = [key](std::span<const Signal> signals) { return std::ranges::find(signals, key, &Signal::key) != signals.end(); };
    do_carry = do_carry && (key == 0 || has(group) || has(second_group));
  });
  return do_carry;
}

/// Bytes of a group with these signals.
consteval std::uint8_t bytes_of(std::span<const Signal> signals) {
  unsigned bits = 0;
  for (const Signal& signal : signals) bits = bits < signal.first_bit + signal.bit_count ? signal.first_bit + signal.bit_count : bits;
  return static_cast<std::uint8_t>((bits + 7) / 8);
}

}  // namespace earshot::n2k::table
