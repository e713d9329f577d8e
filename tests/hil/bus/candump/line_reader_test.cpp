#include "hil/bus/candump/line_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace earshot::hil {
namespace {

/// The lines of a text that comes in pieces of so many bytes; "..." for one that is too long.
std::vector<std::string> lines_of(const std::string& text, std::size_t piece) {
  LineReader reader;
  std::vector<std::string> lines;
  const auto take_all = [&] {
    for (TextLine line; reader.next(line);) lines.emplace_back(line.is_too_long ? "..." : line.text);
  };
  for (std::size_t at = 0; at < text.size(); at += piece) {
    reader.add(std::string_view(text).substr(at, piece));
    take_all();
  }
  reader.end();
  take_all();
  return lines;
}

TEST(LineReader, CutsLinesHoweverTheyCome) {
  const std::vector<std::string> expected{"one", "", "two", "three"};
  for (std::size_t piece = 1; piece < 20; ++piece) {
    EXPECT_EQ(lines_of("one\n\ntwo\nthree", piece), expected) << piece;
    EXPECT_EQ(lines_of("one\n\ntwo\nthree\n", piece), expected) << piece;
  }
}

TEST(LineReader, LeavesOutALineThatIsTooLongAndGoesOn) {
  const std::string most(LineReader::kMostBytes, 'x');
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{100'000}}) {
    EXPECT_EQ(lines_of(most + "\n" + most + "y\nnext", piece), (std::vector<std::string>{most, "...", "next"})) << piece;
    EXPECT_EQ(lines_of("first\n" + most + "y", piece), (std::vector<std::string>{"first", "..."})) << piece;
  }
}

}  // namespace
}  // namespace earshot::hil
