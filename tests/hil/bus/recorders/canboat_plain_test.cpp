#include "hil/bus/recorders/canboat_plain.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

LogEntry entry_of(CanboatReader& reader, const char* line) {
  EXPECT_TRUE(CanboatReader::knows(line)) << line;
  const LineOr read = reader.read(line);
  EXPECT_TRUE(std::holds_alternative<LogEntry>(read)) << line;
  return std::holds_alternative<LogEntry>(read) ? std::get<LogEntry>(read) : LogEntry{};
}

// Lines of canboat's samples. date -u -d '2011-04-25 10:16:43' +%s gives 1303726603.
TEST(CanboatPlain, ReadsAFrameALine) {
  CanboatReader reader;
  EXPECT_EQ(entry_of(reader, "2011-04-25-10:16:43.004,2,127250,3,255,8,ff,8b,0a,ff,7f,ff,7f,fd"),
            (LogEntry{.time = Time{1'303'726'603'004'000},
                      .interface = "can0",
                      .frame = n2k::Frame{.identifier = 0x09F11203, .size = 8, .data = {0xFF, 0x8B, 0x0A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}}}));
  EXPECT_EQ(entry_of(reader, "08:15:07.204,6,60928,64,255,8,4F,28,A9,59,00,89,32,C0").frame->identifier, 0x18EEFF40U);
  EXPECT_EQ(entry_of(reader, "2022-04-17-04:35:34.254,6,59904,3,68,3,14,f0,1").frame->identifier, 0x18EA4403U);
}

TEST(CanboatPlain, ReadsStampsInAllTheirForms) {
  CanboatReader reader;
  for (const char* line :
       {"2011-04-25-10:16:43.004,2,127250,3,255,0", "2011-04-25T10:16:43.004Z,2,127250,3,255,0", "2011-04-25Z10:16:43.004,2,127250,3,255,0",
        "2011-04-25T03:16:43.004000999-07:00,2,127250,3,255,0", "2011-04-25T15:46:43.004+05:30,2,127250,3,255,0"})
    EXPECT_EQ(entry_of(reader, line).time, Time{1'303'726'603'004'000}) << line;
  EXPECT_EQ(entry_of(reader, "08:15:07.204,2,127250,3,255,0").time, Time{29'707'204'000});
  EXPECT_EQ(entry_of(reader, "1969-12-31T16:00:34.206,2,127250,3,255,0").time, std::nullopt);
}

constexpr const char* kWhole = "2020-04-19T00:35:55.571Z,2,126208,0,67,21,01,16,f0,01,ff,01,02,0e,01,59,44,3a,56,4f,4c,55,4d,45,20,36,30";

TEST(CanboatPlain, ReadsAMessageALine) {
  CanboatReader reader;
  const LogEntry entry = entry_of(reader, kWhole);
  EXPECT_FALSE(entry.frame);
  ASSERT_TRUE(entry.message);
  EXPECT_EQ(entry.message->identifier, (n2k::Identifier{.pgn = 126208, .priority = 2, .source = 0, .destination = 67}));
  EXPECT_EQ(entry.message->bytes.size(), 21U);
  EXPECT_EQ(entry.message->bytes.back(), 0x30);
}

// 126998 fits 8 bytes where its texts are short; 129029 never does.
TEST(CanboatPlain, TakesShortLinesForMessagesOnlyBehindALongOne) {
  constexpr const char* kTexts = "2020-04-19T00:35:55.571Z,6,126998,0,255,8,04,01,61,62,02,01,02,01";
  constexpr const char* kGnss = "2020-04-19T00:35:55.571Z,3,129029,0,255,8,00,2f,e7,95,3d,00,73,d6";
  CanboatReader reader;
  EXPECT_TRUE(entry_of(reader, kTexts).frame);
  (void)entry_of(reader, kWhole);
  EXPECT_TRUE(entry_of(reader, kTexts).message);
  EXPECT_TRUE(entry_of(reader, kGnss).frame);
  reader.read_comment("# format=PLAIN");
  EXPECT_TRUE(entry_of(reader, kTexts).frame);
  reader.read_comment("# format=FAST");
  EXPECT_TRUE(entry_of(reader, kGnss).message);
}

TEST(CanboatPlain, LeavesOutThePaddingBehindAMessage) {
  CanboatReader reader;
  const auto entry = entry_of(reader, "2024-07-19-23:24:46.913,3,130824,27,255,10,7d,99,7e,20,cb,00,7c,20,00,05,ff,ff,ff,ff");
  ASSERT_TRUE(entry.message);
  EXPECT_EQ(entry.message->bytes.size(), 10U);
}

TEST(CanboatPlain, PassesOverWhatAnInterfaceSaysOfItself) {
  CanboatReader reader;
  EXPECT_EQ(reader.read("2021-01-27T23:33:50.468Z,7,262400,0,255,3,12,01,00"), LineOr(Remark{}));
}

TEST(CanboatPlain, IsRefusedWhereItIsDamaged) {
  CanboatReader reader;
  for (const char* line :
       {"2011-13-25-10:16:43.004,2,127250,3,255,0", "2011-04-25_10:16:43.004,2,127250,3,255,0", "2011-04-25-10:16:43.0x,2,127250,3,255,0",
        "2011-04-25T10:16:43.0+5,2,127250,3,255,0", "2011-04-25", "2011-04-25-10:16:43.004,8,127250,3,255,0",
        "2011-04-25-10:16:43.004,2,x,3,255,0", "2011-04-25-10:16:43.004,2,127250,256,255,0", "2011-04-25-10:16:43.004,2,127250,3,255,2,ff",
        "2011-04-25-10:16:43.004,2,127250,3,255,1,ff,fe", "2011-04-25-10:16:43.004,2,127250,3,255,1,fff",
        "2011-04-25-10:16:43.004,2,59905,3,255,1,ff", "2011-04-25-10:16:43.004,2,127250,3,255,1786"})
    EXPECT_TRUE(std::holds_alternative<std::string_view>(reader.read(line))) << line;
}

}  // namespace
}  // namespace earshot::hil
