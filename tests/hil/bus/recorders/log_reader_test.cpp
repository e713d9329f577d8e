#include "hil/bus/recorders/log_reader.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

TEST(LogReader, ReadsLinesOfCandumpAndOfAGatewayOfYachtDevices) {
  const n2k::Frame heading{.identifier = 0x09F11223, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
  LogReader reader;
  EXPECT_EQ(std::get<LogEntry>(reader.read("(1700000000.000000) can0 09F11223#FF705AFF7FFF7FFD")).frame, heading);
  EXPECT_EQ(std::get<LogEntry>(reader.read("17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD\r")).frame, heading);
}

}  // namespace
}  // namespace earshot::hil
