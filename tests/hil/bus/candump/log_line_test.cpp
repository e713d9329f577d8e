#include "hil/bus/candump/log_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

namespace earshot::hil {
namespace {

constexpr n2k::Frame kPosition{.identifier = 0x09F8017F, .size = 8, .data = {0x50, 0xC3, 0xB8, 0x13, 0x47, 0xD8, 0x2B, 0xC6}};
constexpr n2k::Frame kEmpty{.identifier = 0x09F8017F, .size = 0};

LogEntry entry_of(const std::string& line) {
  const LineOr read = read_line(line);
  EXPECT_TRUE(std::holds_alternative<LogEntry>(read)) << line;
  return std::holds_alternative<LogEntry>(read) ? std::get<LogEntry>(read) : LogEntry{};
}

bool is_refused(const std::string& line) {
  return std::holds_alternative<std::string_view>(read_line(line));
}

// What can-utils 2020.11 printed of the frames that cansend sent on a vcan0.

TEST(LogLine, ReadsWhatCandumpLogs) {
  EXPECT_EQ(entry_of("(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC6"),
            (LogEntry{.time = Time{1'795'415'485'080'925}, .interface = "vcan0", .frame = kPosition}));
  EXPECT_EQ(entry_of("(1795415485.124552) vcan0 09F8017F#").frame, kEmpty);
}

TEST(LogLine, ReadsStampsInNanosecondsToTheMicrosecondBefore) {
  EXPECT_EQ(entry_of("(1795415485.080925999) vcan0 09F8017F#").time, Time{1'795'415'485'080'925});
  EXPECT_TRUE(is_refused("(1795415485.0809259) vcan0 09F8017F#"));
  EXPECT_TRUE(is_refused("(1795415485.080925x99) vcan0 09F8017F#"));
}

TEST(LogLine, ReadsWhatCandumpPrints) {
  EXPECT_EQ(entry_of("  vcan0  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6"),
            (LogEntry{.time = std::nullopt, .interface = "vcan0", .frame = kPosition}));
  EXPECT_EQ(entry_of(" (1795415485.080925)  vcan0  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6"),
            (LogEntry{.time = Time{1'795'415'485'080'925}, .interface = "vcan0", .frame = kPosition}));
  EXPECT_EQ(entry_of(" (000.026087)  vcan0  09F8017F   [0] "), (LogEntry{.time = Time{26'087}, .interface = "vcan0", .frame = kEmpty}));
}

TEST(LogLine, ReadsDatesFlagsAndCharactersOfTheScreen) {
  ::setenv("TZ", "UTC0", 1);
  ::tzset();
  const LogEntry expected{.time = Time{1'795'415'485'080'925}, .interface = "vcan0", .frame = kPosition};
  EXPECT_EQ(entry_of(" (2026-11-23 06:31:25.080925)  vcan0  TX - -  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6   'P...G.+.'"), expected);
  EXPECT_EQ(entry_of(" (2026-11-23 06:31:25.124552)  vcan0  TX - -  09F8017F   [0]                            ''").frame, kEmpty);
}

TEST(LogLine, KnowsFramesThatNmea2000HasNoUseFor) {
  for (const char* line :
       {"(1795415485.107012) vcan0 123#R", "(1795415485.112993) vcan0 123#R4", "(1795415485.118697) vcan0 123#0102",
        "(1795415485.129689) vcan0 09F8017F#R", "(1795415485.147817) vcan0 09F8017F##5000102030405060708090A0B",
        "  vcan0       123   [0]  remote request", "  vcan0       123   [4]  remote request", "  vcan0       123   [2]  01 02",
        "  vcan0  09F8017F   [0]  remote request", "  vcan0  09F8017F  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B",
        " (2026-11-23 06:31:25.118697)  vcan0  TX - -       123   [2]  01 02                     '..'",
        // An error frame: CAN_ERR_FLAG and the class "transceiver status"; candump -e writes the second.
        "(1795415485.200000) can0 20000010#0000000000000000", "  can0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME"}) {
    EXPECT_FALSE(entry_of(line).frame.has_value()) << line;
  }
}

// As in canboat's candumpSample1.txt: candump before can-utils.
TEST(LogLine, ReadsTheOldFormInAngles) {
  EXPECT_EQ(entry_of("<0x09f8017f> [8] 50 c3 b8 13 47 d8 2b c6 "),
            (LogEntry{.time = std::nullopt, .interface = "can0", .frame = kPosition}));
  EXPECT_EQ(read_line("interface = can0, family = 29, type = 3, proto = 1"), LineOr(Remark{}));
  EXPECT_FALSE(entry_of("<0x123> [2] 01 02").frame.has_value());
  for (const char* line : {"<0x09f8017f [8] 50 c3 b8 13 47 d8 2b c6", "<0x> [0]", "<0x09f8017f> [8] 50 c3", "<0x09f8017f>"})
    EXPECT_TRUE(is_refused(line)) << line;
}

// lib.c of can-utils, snprintf_can_error_frame(): each class of an error frame in a line of its own.
TEST(LogLine, TakesCommentsAndExplanationsForRemarks) {
  for (const char* line : {"# log of the trial, bow compass only", "#", "\tcontroller-problem{rx-overflow}", "\tbus-off",
                           "\tprotocol-violation{{single-bit-error,error-on-tx}{data-field}}", "\tlost-arbitration{at bit 3}",
                           "\terror-counter-tx-rx{{127}{0}}\r"}) {
    EXPECT_EQ(read_line(line), LineOr(Remark{})) << line;
  }
  for (const char* line : {"\tbus", "\tbus-off 1", "\tcontroller-problem{rx-over", "bus-offx"}) EXPECT_TRUE(is_refused(line)) << line;
}

TEST(LogLine, CountsTheFramesThatCandumpSaysItLost) {
  EXPECT_EQ(read_line("DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 5)"), LineOr(Remark{.lost_frames = 3}));
  EXPECT_TRUE(is_refused("DROPCOUNT: dropped some CAN frames on 'can0' socket (total drops 5)"));
}

TEST(LogLine, TakesTheDirectionAndTheLengthCodeThatNewerOnesWrite) {
  EXPECT_EQ(entry_of("(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC6 R").frame, kPosition);
  EXPECT_EQ(entry_of("(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC6_A T").frame, kPosition);
}

TEST(LogLine, RefusesWhatIsDamaged) {
  for (const char* line : {"",
                           "(1795415485.080925",
                           "(1795415485.08092) vcan0 09F8017F#50",
                           "(x.080925) vcan0 09F8017F#50",
                           "(1795415485.080925)",
                           "(1795415485.080925) vcan0",
                           "(1795415485.080925) vcan0 09F8017#50",
                           "(1795415485.080925) vcan0 09F8017F#5",
                           "(1795415485.080925) vcan0 09F8017F#5G",
                           "(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC600",
                           "(1795415485.080925) vcan0 49F8017F#50",
                           "(1795415485.080925) vcan0 FFF#50",
                           "(1795415485.080925) vcan0 09F8017F#50 X",
                           "(99999999999999999999.000000) vcan0 09F8017F#50",
                           "(2026-13-23 06:31:25.080925) vcan0 09F8017F#50",
                           "(1795415485.080925) a_name_of_17_chars 09F8017F#50",
                           "(1795415485.080925) vcan0 09F8017F#R9",
                           "  vcan0  09F8017F   [8]  50 C3",
                           "  vcan0  09F8017F   [2]  50 C3 B8",
                           "  vcan0  09F8017F   [65]  50",
                           "  vcan0  09F8017F   50 C3",
                           "  vcan0  TX x -  09F8017F   [1]  50",
                           "Latitude = 3"}) {
    EXPECT_TRUE(is_refused(line)) << line;
  }
}

TEST(LogLine, IsWrittenAsCandumpDoes) {
  EXPECT_EQ(log_line(Time{1'795'415'485'080'925}, "vcan0", kPosition), "(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC6\n");
  EXPECT_EQ(log_line(Time{26'087}, "can0", kEmpty), "(0000000000.026087) can0 09F8017F#\n");
}

// Random frames, times and names.
TEST(LogLine, IsReadAsItWasWritten) {
  std::mt19937_64 dice(1);
  constexpr std::array kNames{"can0", "vcan0", "a", "slcan-15-letter", "(x)", "RX", "#"};
  for (int i = 0; i < 20'000; ++i) {
    LogEntry entry{.time = Time{static_cast<std::int64_t>(dice() >> (1 + dice() % 40))},
                   .interface = kNames.at(dice() % kNames.size()),
                   .frame = n2k::Frame{.identifier = static_cast<std::uint32_t>(dice()) & 0x1FFF'FFFFU,
                                       .size = static_cast<std::uint8_t>(dice() % 9)}};
    // Seconds of up to ten digits are candump's own; more are read as well, as far as microseconds can count.
    entry.time->us = std::min<std::int64_t>(entry.time->us, std::int64_t{9'000'000'000'000} * 1'000'000);
    for (std::size_t k = 0; k < entry.frame->size; ++k) entry.frame->data.at(k) = static_cast<std::uint8_t>(dice());
    std::string line = log_line(*entry.time, entry.interface, *entry.frame);
    ASSERT_EQ(line.back(), '\n');
    line.pop_back();
    ASSERT_EQ(entry_of(line), entry) << line;
  }
}

// Whole lines with bytes changed, left out and put in: whatever comes, what is taken is a frame that can be written and read again.
TEST(LogLine, OutlivesNoise) {
  constexpr std::array kLines{"(1795415485.080925) vcan0 09F8017F#50C3B81347D82BC6", "  vcan0  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6",
                              " (2026-11-23 06:31:25.080925)  vcan0  TX - -  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6   'P...G.+.'",
                              "(1795415485.147817) vcan0 09F8017F##5000102030405060708090A0B"};
  std::mt19937_64 dice(2);
  int taken = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::string line = kLines.at(dice() % kLines.size());
    for (std::uint64_t changes = dice() % 4; changes > 0 && !line.empty(); --changes) {
      const std::size_t at = dice() % line.size();
      const auto byte = static_cast<char>(dice() % 3 == 0 ? dice() : line[dice() % line.size()]);
      if (dice() % 3 == 0) line.erase(at, dice() % 5);
      if (dice() % 3 == 0) line.insert(std::min(at, line.size()), 1, byte);
      if (dice() % 3 == 0 && at < line.size()) line[at] = byte;
    }
    const LineOr read = read_line(line);
    if (!std::holds_alternative<LogEntry>(read)) continue;
    ++taken;
    const LogEntry& entry = std::get<LogEntry>(read);
    if (!entry.frame || !entry.time) continue;
    std::string again = log_line(*entry.time, entry.interface, *entry.frame);
    again.pop_back();
    ASSERT_EQ(entry_of(again), entry) << line;
  }
  EXPECT_GT(taken, 20'000);  // a quarter has no change, so that the noise did not drown all
}

}  // namespace
}  // namespace earshot::hil
