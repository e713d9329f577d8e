#include "hil/bus/serial/slcan_line.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::hil {
namespace {

const n2k::Frame kHeading{.identifier = 0x09F11223, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};

// What can-utils' cansend of Debian 12 put on a line of Linux 6.1's slcan, and what its interface took of one.
TEST(SlcanLine, WritesAFrameAsTheKernelDoes) {
  EXPECT_EQ(to_line(kHeading), "T09F112238FF705AFF7FFF7FFD\r");
  EXPECT_EQ(to_line(n2k::Frame{.identifier = 0x1F, .size = 0, .data = {}}), "T0000001F0\r");
}

TEST(SlcanLine, ReadsWhatItWrites) {
  EXPECT_EQ(read_line("T09F112238FF705AFF7FFF7FFD"), kHeading);
  EXPECT_EQ(read_line("t09f112238ff705aff7fff7ffd"), std::nullopt) << "eleven bits";
}

TEST(SlcanLine, TellsTheStatesWithTheErrorsThatTheyTake) {
  EXPECT_EQ(to_line(n2k::ControllerState::kErrorActive), "sa000000\r");
  EXPECT_EQ(to_line(n2k::ControllerState::kErrorPassive), "sp128000\r");
  EXPECT_EQ(to_line(n2k::ControllerState::kBusOff), "sb000256\r");
}

TEST(SlcanLine, TakesNoFrameOutOfACommandOrADamagedLine) {
  for (const char* line : {"", "O", "C", "S5", "T", "T09F11223", "T09F112239FF705AFF7FFF7FFDFF", "T09F112238FF705AFF7FFF7FF", "T29F112230",
                           "T09F1122G0", "T09F1122318G", "T-9F112230"})
    EXPECT_EQ(read_line(line), std::nullopt) << line;
}

}  // namespace
}  // namespace earshot::hil
