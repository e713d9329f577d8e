#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/config/listening_window.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// "newest", "loudest" or "mean".
[[nodiscard]] std::string_view word_for(config::Listening listening);

/// "newest", "mean of 30 s".
[[nodiscard]] std::string to_string(config::ListeningWindow window);

/// The window that a word and a length make.
/// Throws BadInput, without naming a key, when the word is not known, newest is given a window, or another none of 1 to
/// kMaxListeningSeconds.
[[nodiscard]] config::ListeningWindow listening_window(const std::string& word, std::int64_t length_s);

/// The keys `listening` and `listening_window_s` of a table; without them the newest measurement. What is wrong is noted.
[[nodiscard]] config::ListeningWindow read_listening(TableReader& table);

/// A window's length as those keys have it.
[[nodiscard]] constexpr std::int64_t length_s(config::ListeningWindow window) {
  return window.length.us / Duration::seconds(1).us;
}

}  // namespace earshot::host
