#include "hil/bus/recorders/yacht_devices.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

// Of canboat's sample-YDWG02-2.txt. 00:54:47.929 is (54 * 60 + 47) s + 929 ms.
TEST(YachtDevices, ReadsWhatTheGatewayHeardAndSent) {
  YachtDevicesReader reader;
  EXPECT_EQ(reader.read("00:54:47.929 T 18EAFF44 14 F0 01"),
            LineOr(LogEntry{.time = Time{3'287'929'000},
                            .interface = "can0",
                            .frame = n2k::Frame{.identifier = 0x18EAFF44, .size = 3, .data = {0x14, 0xF0, 0x01}}}));
  EXPECT_EQ(std::get<LogEntry>(reader.read("00:54:47.963 R 19F01400 13 02 01 FF FF FF FF FF")).frame->size, 8);
}

TEST(YachtDevices, CountsOnBeyondMidnight) {
  YachtDevicesReader reader;
  const auto time = [&](const char* line) { return std::get<LogEntry>(reader.read(line)).time; };
  EXPECT_EQ(time("23:59:59.999 R 18EAFF44 14 F0 01"), Time{86'399'999'000});
  EXPECT_EQ(time("00:00:00.001 R 18EAFF44 14 F0 01"), Time{86'400'001'000});
  EXPECT_EQ(time("00:00:00.000 R 18EAFF44 14 F0 01"), Time{86'400'000'000});  // a frame that waited a little
}

TEST(YachtDevices, RefusesWhatIsDamaged) {
  YachtDevicesReader reader;
  for (const char* line : {"24:00:00.000 R 18EAFF44 14 F0 01", "00:54:47 R 18EAFF44 14 F0 01", "00:54:47.9x R 18EAFF44 14 F0 01",
                           "00:54:47.929 X 18EAFF44 14", "00:54:47.929 R 8EAFF44 14", "00:54:47.929 R 38EAFF44 14", "00:54:47.929 R",
                           "00:54:48.015 R 19F20000 00 00 00 FF FF FF FF FF F0", "00:54:48.015 R 19F20000 0"}) {
    EXPECT_TRUE(YachtDevicesReader::knows(line)) << line;
    EXPECT_TRUE(std::holds_alternative<std::string_view>(reader.read(line))) << line;
  }
}

}  // namespace
}  // namespace earshot::hil
