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
// bus.

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

/// A field's place with the names of its values, where its type has some.
template <class Line>
constexpr Signal named(const Line& line) {
  Signal signal = line.format.bus;
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

/// Bytes of a group with these signals.
consteval std::uint8_t bytes_of(std::span<const Signal> signals) {
  unsigned bits = 0;
  for (const Signal& signal : signals) bits = bits < signal.first_bit + signal.bit_count ? signal.first_bit + signal.bit_count : bits;
  return static_cast<std::uint8_t>((bits + 7) / 8);
}

}  // namespace earshot::n2k::table
