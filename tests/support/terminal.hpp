#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace earshot::support {

/// What a program showed on a terminal.
struct Shown {
  std::string text;
  int status = -1;  ///< as Process::wait gives it
};

/// Runs a program with a pseudo-terminal of its own as its standard input, output and error, one that halts who writes from the background.
/// @param until  the program is killed as soon as it has shown this; empty: it runs to its end. Either way for a minute at most.
[[nodiscard]] Shown shown_on_terminal(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                      const std::string& until = {});

}  // namespace earshot::support
