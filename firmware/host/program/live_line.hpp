#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace earshot::program {

/// One line on a terminal, drawn anew over itself while work goes on that takes longer than a second, and gone at its end. It stands on
/// standard error, or on standard output when that alone is a terminal; without a terminal and with --quiet there is none.
/// Oracle: Talk.* in tests/scenario, Programs.EvaluateShowsOnATerminalHowFarItIs
class LiveLine {
 public:
  LiveLine();
  ~LiveLine();
  LiveLine(const LiveLine&) = delete;
  LiveLine& operator=(const LiveLine&) = delete;

  /// Whether it is time to draw, a few times a second: so long there is no need to make the text. Costs a reading of the clock.
  [[nodiscard]] bool is_due() const;
  /// @param text  printable ASCII; what the terminal is too narrow for is left out
  void draw(const std::string& text);

 private:
  using steady_clock = std::chrono::steady_clock;

  std::FILE* terminal_;  ///< none: silence
  steady_clock::time_point due_ = steady_clock::now() + std::chrono::seconds(1);
  bool is_drawn_ = false;
};

}  // namespace earshot::program
