#include "firmware/host/file/bad_input.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::host {
namespace {

TEST(BadInput, SpellsOutWhatASteeredTerminalWouldObey) {
  EXPECT_STREQ(BadInput("a.toml:1: \x1b[2J\x1b[31m: unknown key").what(), "a.toml:1: \\x1b[2J\\x1b[31m: unknown key");
}

TEST(BadInput, KeepsItsLines) {
  EXPECT_STREQ(BadInput("a.toml:1: x\na.toml:2: y").what(), "a.toml:1: x\na.toml:2: y");
}

TEST(BadInput, SaysHowMuchOfALongMessageItLeavesOut) {
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += std::string(999, 'a') + "\n";
  const std::string message = BadInput(lines).what();
  EXPECT_EQ(message.substr(16'384), "... (983616 more bytes)");
}

// A chart with "units" of a million characters was told of in 16 kB.
TEST(BadInput, TellsABeginAndAnEndOfALongLineAndTheOthersWhole) {
  const std::string value(1'000'000, 'x');
  const std::string message =
      BadInput("a.nc: elevation: units must be m, are " + value + "\na.nc: " + value + ": must be m\nb.nc: unknown").what();
  EXPECT_EQ(message, "a.nc: elevation: units must be m, are " + std::string(667 - 38, 'x') + "... (999038 more bytes) ..." +
                         std::string(333, 'x') + "\na.nc: " + std::string(667 - 6, 'x') + "... (999017 more bytes) ..." +
                         std::string(333 - 11, 'x') + ": must be m\nb.nc: unknown");
}

}  // namespace
}  // namespace earshot::host
