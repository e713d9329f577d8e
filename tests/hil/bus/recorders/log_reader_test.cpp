#include "hil/bus/recorders/log_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

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

// Lines of all recorders with bytes changed, left out and put in: what is taken is a frame or a message that can be sent.
TEST(LogReader, OutlivesNoise) {
  const std::array<std::vector<std::string>, 5> logs{{
      {";$FILEVERSION=2.1", ";$STARTTIME=45244.925926488424", ";$COLUMNS=N,O,T,B,I,d,R,L,D",
       "0 0.000 DT 1 9F11223 Rx - 8 FF 70 5A FF 7F FF 7F FD"},
      {";$FILEVERSION=1.1", "1)  48.6  Rx  09F11223  8  FF 70 5A FF 7F FF 7F FD"},
      {"date Tue Nov 14 10:13:20.123 pm 2023", "base hex  timestamps absolute", "0.0 1 9F11223x Rx d 8 FF 70 5A FF 7F FF 7F FD",
       "1.0 CANFD 1 Rx 9F11223x 0 0 8 8 FF 70 5A FF 7F FF 7F FD 100000 214 0"},
      {"Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8", "1,9F11223,true,Rx,0,8,FF,70,5A,FF,7F,FF,7F,FD,"},
      {"17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD", "<0x09f11223> [8] ff 70 5a ff 7f ff 7f fd",
       "2011-04-25-10:16:43.004,2,127250,35,255,8,ff,70,5a,ff,7f,ff,7f,fd",
       "2011-04-25T10:16:43.004-07:00,2,126998,35,255,9,ff,70,5a,ff,7f,ff,7f,fd,00"},
  }};
  std::mt19937_64 dice(5);
  int taken = 0;
  for (int i = 0; i < 20'000; ++i) {
    LogReader reader;
    for (std::string line : logs.at(dice() % logs.size())) {
      for (std::uint64_t changes = dice() % 3; changes > 0 && !line.empty(); --changes) {
        const std::size_t at = dice() % line.size();
        const auto byte = static_cast<char>(dice() % 3 == 0 ? dice() : line[dice() % line.size()]);
        if (dice() % 3 == 0) line.erase(at, dice() % 5);
        if (dice() % 3 == 0) line.insert(std::min(at, line.size()), 1, byte);
        if (dice() % 3 == 0 && at < line.size()) line[at] = byte;
      }
      const LineOr read = reader.read(line);
      const auto* const entry = std::get_if<LogEntry>(&read);
      if (entry == nullptr) continue;
      ++taken;
      ASSERT_FALSE(entry->interface.empty()) << line;
      if (entry->frame) {
        ASSERT_LE(entry->frame->size, 8) << line;
        ASSERT_LE(entry->frame->identifier, 0x1FFF'FFFFU) << line;
      }
      if (entry->message) {
        ASSERT_TRUE(n2k::compose(entry->message->identifier).ok()) << line;
      }
    }
  }
  EXPECT_GT(taken, 10'000);
}

}  // namespace
}  // namespace earshot::hil
