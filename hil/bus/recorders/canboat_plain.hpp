#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// Reads canboat's own format (.raw; "plain" with one frame a line, "fast" with one message a line), line by line.
///
///   2011-04-25-06:25:02.017,2,127250,7,255,8,00,53,1d,ff,7f,ff,7f,fd
///   2022-09-28T11:36:59.668Z,3,129029,0,255,43,e5,e0,4a,...
///
/// Time (UTC where it names no zone; a time of day counts from midnight), priority, group, source, destination, size, bytes. A line of more
/// than 8 bytes is a message that canboat put together. Others are frames until the first such line, and behind it messages too, unless no
/// message of their group is so short; a line "# format=FAST" or "# format=PLAIN" says which from the beginning.
/// Source: canboat, analyzer (Apache-2.0).   Oracle: CanboatPlain tests on canboat's samples
class CanboatReader {
 public:
  static constexpr std::size_t kLongest = 1785;  ///< bytes, of the transport protocol

  /// Whether a line may be one of these.
  [[nodiscard]] static bool knows(std::string_view line);
  [[nodiscard]] LineOr read(std::string_view line);
  /// Of a comment: what it says of the lines behind it.
  void read_comment(std::string_view line);

 private:
  enum class Lines : std::uint8_t { kAnything, kFramesAndMessages, kFrames, kMessages };
  [[nodiscard]] bool is_message(std::uint32_t pgn, std::size_t bytes) const;
  Lines lines_ = Lines::kAnything;
};

}  // namespace earshot::hil
