#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "firmware/messages/dictionary/words.hpp"

namespace earshot::messages {

// The words of an enum held against the enum itself. C++20 cannot list an enum's values; but a compiler that prints the name of a function
// prints a value by its own name if it has one ("EndReason::kFound"), and else as a number ("(EndReason)12"). Both GCC and clang do.

template <auto kValue>
consteval bool has_a_name() {
  constexpr std::string_view kFunction = __PRETTY_FUNCTION__;
  constexpr std::string_view kBefore = "kValue = ";
  return kFunction[kFunction.find(kBefore) + kBefore.size()] != '(';
}

/// Whether a table has a row for each value of an enum and for nothing else, in their order and without a gap.
/// @param value  which member of a row is the enum's
template <class Enum, class Row, std::size_t kRows>
consteval bool has_a_row_for_each(const std::array<Row, kRows>& table, Enum Row::*value) {
  constexpr std::size_t kMost = 256;
  const auto named = []<std::size_t... kValues>(std::index_sequence<kValues...>) {
    return std::array{has_a_name<static_cast<Enum>(kValues)>()...};
  }
  (std::make_index_sequence<kMost>{});
  std::size_t row = 0;
  for (std::size_t i = 0; i < kMost; ++i) {
    if (!named[i]) continue;
    if (row == kRows || table[row].*value != static_cast<Enum>(i)) return false;
    if (row > 0 && !named[i - 1]) return false;
    ++row;
  }
  return row == kRows;
}

/// Whether the table of an enum has a row for each of its values and for nothing else, in their order, all of them with words, and no two
/// with the same key. Values go to 127: no more has room in LCM's int8_t.
template <HasWords Enum>
consteval bool has_all_words() {
  const auto& table = WordsOf<Enum>::kTable;
  if (!has_a_row_for_each(table, &Word<Enum>::value) || static_cast<std::size_t>(kHighest<Enum>) > 127) return false;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].key.empty() || table[i].name.empty() || table[i].words.empty()) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (table[i].key == table[j].key || table[i].name == table[j].name || table[i].words == table[j].words) return false;
    }
  }
  return true;
}

}  // namespace earshot::messages
