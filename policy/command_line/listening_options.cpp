#include "policy/command_line/listening_options.hpp"

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/listening/listening_words.hpp"

namespace earshot::command_line {

void ListeningOptions::add_to(program::CommandLine& line, const std::string& otherwise) {
  line.option("--listening", &listening,
              "what an observation hears of its step: the newest SNR measurement, or the loudest or mean of those in the window that were "
              "measured (" +
                  otherwise + ")")
      .one_of({config::kListeningWords.begin(), config::kListeningWords.end()});
  const std::string allowed = "1 to " + std::to_string(config::kMaxListeningSeconds);
  const auto complaint = [allowed](const std::string& text) {
    const std::optional<std::int64_t> seconds = program::whole_number(text);
    if (seconds && *seconds >= 0 && *seconds <= static_cast<std::int64_t>(config::kMaxListeningSeconds)) return std::string();
    return text + ": must be whole seconds, " + allowed + ", or 0 with newest";
  };
  line.option("--listening-window-s", &listening_window_s,
              "window before the end of a step, whole seconds; 0 with newest (with --listening alone the length stays, but for newest)")
      .checked(complaint, allowed + ", 0 with newest");
}

config::ListeningWindow ListeningOptions::applied_to(config::ListeningWindow standing) const {
  const std::string word = listening.value_or(std::string(host::word_for(standing.listening)));
  const std::int64_t standing_s = word == host::word_for(config::Listening::kNewest) ? 0 : host::length_s(standing);
  try {
    return host::listening_window(word, listening_window_s ? std::int64_t{*listening_window_s} : standing_s);
  } catch (const host::BadInput& e) {
    throw host::BadInput(std::string("--listening, --listening-window-s: ") + e.what());
  }
}

}  // namespace earshot::command_line
