#include "hil/bus/recorders/log_reader.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bus/recorders/heading.hpp"

namespace earshot::hil {
namespace {

TEST(LogReader, ReadsLinesOfCandumpAndOfAGatewayOfYachtDevices) {
  LogReader reader;
  EXPECT_EQ(std::get<LogEntry>(reader.read("(1700000000.000000) can0 09F11223#FF705AFF7FFF7FFD")).frame, kHeading);
  EXPECT_EQ(std::get<LogEntry>(reader.read("17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD\r")).frame, kHeading);
}

TEST(LogReader, ChoosesByTheHeaderElseByTheFormOfEachLine) {
  const auto last_of = [](std::initializer_list<const char*> lines) {
    LogReader reader;
    LineOr last;
    for (const char* const line : lines) last = reader.read(line);
    return std::holds_alternative<LogEntry>(last) ? std::get<LogEntry>(last).frame : std::nullopt;
  };
  EXPECT_EQ(last_of({";$FILEVERSION=1.1\r", "  1)  48.6  Rx  09F11223  8  FF 70 5A FF 7F FF 7F FD \r"}), kHeading);
  EXPECT_EQ(last_of({"date Tue Nov 14 22:13:20 2023", "base hex  timestamps absolute", "   0.0 1 9F11223x Rx d 8 FF 70 5A FF 7F FF 7F FD"}),
            kHeading);
  EXPECT_EQ(last_of({"\xEF\xBB\xBFTime Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8", "1,9F11223,true,0,8,FF,70,5A,FF,7F,FF,7F,FD,"}),
            kHeading);
  EXPECT_EQ(last_of({"2011-04-25-10:16:43.004,2,127250,35,255,8,ff,70,5a,ff,7f,ff,7f,fd"}), kHeading);
  EXPECT_EQ(last_of({"08:15:07.204,2,127250,35,255,8,ff,70,5a,ff,7f,ff,7f,fd"}), kHeading);
  EXPECT_EQ(last_of({"# format=FAST", "08:15:07.204,2,127250,35,255,8,ff,70,5a,ff,7f,ff,7f,fd"}), std::nullopt);
}

}  // namespace
}  // namespace earshot::hil
