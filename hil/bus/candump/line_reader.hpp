#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace earshot::hil {

/// A line of a text that comes piece by piece.
struct TextLine {
  std::string_view text;     ///< without its end; valid until the next call
  bool is_too_long = false;  ///< its text is left out
};

/// Cuts what comes into lines. Holds one line of at most kMostBytes, whatever comes: the longest message that canboat writes has 5400.
class LineReader {
 public:
  static constexpr std::size_t kMostBytes = 8192;

  /// Adds what was read behind what is not taken yet; it must live until next() gives nothing.
  void add(std::string_view piece) { piece_ = piece; }
  /// What was added last is the end: a last line needs no end of its own.
  void end() { is_at_end_ = true; }
  /// @return false: there is no whole line
  [[nodiscard]] bool next(TextLine& line);

 private:
  std::string_view piece_;
  std::string begun_;  ///< of a line that began in an earlier piece
  std::string whole_;
  bool is_at_end_ = false;
  bool is_too_long_ = false;
};

}  // namespace earshot::hil
