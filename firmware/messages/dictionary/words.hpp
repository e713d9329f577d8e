#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace earshot::messages {

/// How one value of an enum is called.
template <class Enum>
struct Word {
  Enum value{};
  std::string_view key;    ///< in files and results: "navigation_stale"
  std::string_view name;   ///< on CAN, in the DBC, in tables: "navigation stale"
  std::string_view words;  ///< in a sentence: "navigation went silent"
};

/// The words of an enum: kTable has a row for each value, in their order and without a gap; kUnknown is said of what is none; kInRecords is
/// how a journal's records say it when they are exported. Every enum that a message bears has its words in this folder, and complete.cpp
/// does not compile while one of its values has none. kMayBeUnknown, where there is one: a message that names another value is taken all
/// the same.
template <class Enum>
struct WordsOf;

template <class Enum>
concept HasWords = requires {
  WordsOf<Enum>::kTable.size();
};

/// The lowest and the highest value. The words do not come along: a microcontroller that asks for these has none of them.
template <HasWords Enum>
inline constexpr Enum kLowest = WordsOf<Enum>::kTable.front().value;
template <HasWords Enum>
inline constexpr Enum kHighest = WordsOf<Enum>::kTable.back().value;

/// Whether a number from outside is one of the values.
template <HasWords Enum, class Number>
requires std::is_integral_v<Number>
[[nodiscard]] constexpr bool is_value_of(Number number) {
  constexpr auto kFrom = static_cast<std::int64_t>(kLowest<Enum>);
  constexpr auto kTo = static_cast<std::int64_t>(kHighest<Enum>);
  const auto wide = static_cast<std::int64_t>(number);
  return wide >= kFrom && wide <= kTo;
}

/// Whether it is one of the values: one that came from outside may be any number.
template <HasWords Enum>
[[nodiscard]] constexpr bool is_known(Enum value) {
  return is_value_of<Enum>(static_cast<std::underlying_type_t<Enum>>(value));
}

/// Null for what is none of the values.
template <HasWords Enum>
[[nodiscard]] constexpr const Word<Enum>* word_of(Enum value) {
  constexpr const auto& kTable = WordsOf<Enum>::kTable;
  if (!is_known(value)) return nullptr;
  return &kTable[static_cast<std::size_t>(value) - static_cast<std::size_t>(kTable.front().value)];
}

/// "navigation_stale"
template <HasWords Enum>
[[nodiscard]] constexpr std::string_view key_of(Enum value) {
  const Word<Enum>* const word = word_of(value);
  return word != nullptr ? word->key : WordsOf<Enum>::kUnknown;
}

/// "navigation stale"
template <HasWords Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  const Word<Enum>* const word = word_of(value);
  return word != nullptr ? word->name : WordsOf<Enum>::kUnknown;
}

/// "navigation went silent"
template <HasWords Enum>
[[nodiscard]] constexpr const char* to_string(Enum value) {
  const Word<Enum>* const word = word_of(value);
  return (word != nullptr ? word->words : WordsOf<Enum>::kUnknown).data();  // a literal, which ends with a zero
}

}  // namespace earshot::messages
