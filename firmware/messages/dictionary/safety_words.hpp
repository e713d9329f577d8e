#pragma once

#include "firmware/config/safety.hpp"
#include "firmware/messages/dictionary/words.hpp"

namespace earshot::messages {

// Rules are a mission's: firmware/config/safety.hpp has their words.

template <>
struct WordsOf<config::Response> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<config::Response>::key;
  static constexpr auto kTable = [] {
    std::array<Word<config::Response>, config::kResponses> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const config::ResponseTraits& traits = config::kResponseTraits[i];
      table[i] = {traits.response, traits.key, traits.name, traits.deed};
    }
    return table;
  }();
};

template <>
struct WordsOf<config::Condition> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<config::Condition>::key;
  static constexpr auto kTable = [] {
    std::array<Word<config::Condition>, config::kConditions> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const config::ConditionTraits& traits = config::kConditionTraits[i];
      table[i] = {static_cast<config::Condition>(i), traits.key, traits.key, traits.meaning};
    }
    return table;
  }();
};

}  // namespace earshot::messages
