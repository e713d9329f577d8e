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
  const std::string message = BadInput(std::string(1'000'000, 'a')).what();
  EXPECT_EQ(message, std::string(16'384, 'a') + "... (983616 more bytes)");
}

}  // namespace
}  // namespace earshot::host
