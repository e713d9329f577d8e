#include "firmware/host/listening/listening_words.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace earshot::host {
namespace {

constexpr auto kMost = static_cast<std::int64_t>(config::kMaxListeningSeconds);

}  // namespace

std::string_view word_for(config::Listening listening) {
  return config::kListeningWords[static_cast<std::size_t>(listening)];
}

std::string to_string(config::ListeningWindow window) {
  const std::string word(word_for(window.listening));
  return window.listening == config::Listening::kNewest ? word : word + " of " + std::to_string(length_s(window)) + " s";
}

config::ListeningWindow listening_window(const std::string& word, std::int64_t length_s) {
  const auto* const found = std::ranges::find(config::kListeningWords, word);
  if (found == config::kListeningWords.end()) throw BadInput("\"" + word + R"(": must be "newest", "loudest" or "mean")");
  const auto listening = static_cast<config::Listening>(found - config::kListeningWords.begin());
  const bool is_newest = listening == config::Listening::kNewest;
  if (is_newest && length_s != 0) throw BadInput("\"newest\" goes without a window, not with one of " + std::to_string(length_s) + " s");
  if (!is_newest && !(length_s >= 1 && length_s <= kMost))
    throw BadInput("\"" + word + "\" needs a window of 1 to " + std::to_string(kMost) + " s, not " + std::to_string(length_s));
  return {.listening = listening, .length = Duration::seconds(length_s)};
}

config::ListeningWindow read_listening(TableReader& table) {
  const std::vector<std::string> words(config::kListeningWords.begin(), config::kListeningWords.end());
  const std::string word = words[table.choice_or("listening", 0, words)];
  const std::int64_t length = table.integer_or("listening_window_s", 0, 0, kMost);
  if (table.is_noted("listening") || table.is_noted("listening_window_s")) return {};
  try {
    return listening_window(word, length);
  } catch (const BadInput& e) {
    table.problem("listening_window_s", e.what());
    return {};
  }
}

}  // namespace earshot::host
