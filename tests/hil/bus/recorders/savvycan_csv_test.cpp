#include "hil/bus/recorders/savvycan_csv.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bus/recorders/heading.hpp"

namespace earshot::hil {
namespace {

TEST(SavvyCanCsv, IsReadByTheNamesOfItsColumns) {
  SavvyCanReader reader;
  EXPECT_EQ(reader.read("Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8"), LineOr(Remark{}));
  EXPECT_EQ(reader.read("166064000,09F11223,true,Rx,0,8,FF,70,5A,FF,7F,FF,7F,FD,"),
            LineOr(LogEntry{.time = Time{166'064'000}, .interface = "can0", .frame = kHeading}));
  EXPECT_EQ(std::get<LogEntry>(reader.read("1700000000000001,0x18EAFF44,1, Tx, 1, 3, 14,F0,01")),
            (LogEntry{.time = Time{1'700'000'000'000'001},
                      .interface = "can1",
                      .frame = n2k::Frame{.identifier = 0x18EAFF44, .size = 3, .data = {0x14, 0xF0, 0x01}}}));
  // Before there was a direction.
  SavvyCanReader older;
  EXPECT_EQ(older.read("Time Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8"), LineOr(Remark{}));
  EXPECT_EQ(std::get<LogEntry>(older.read("1,9F11223,true,0,8,FF,70,5A,FF,7F,FF,7F,FD,")).frame, kHeading);
}

TEST(SavvyCanCsv, KnowsFramesOf11BitsAndOfCanFd) {
  SavvyCanReader reader;
  ASSERT_TRUE(std::holds_alternative<Remark>(reader.read("Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8")));
  EXPECT_FALSE(std::get<LogEntry>(reader.read("1,0000021A,false,Rx,0,2,FE,36")).frame);
  EXPECT_FALSE(std::get<LogEntry>(reader.read("1,09F11223,true,Rx,0,C,0,0,0,0,0,0,0,0,0,0,0,0")).frame);
}

TEST(SavvyCanCsv, IsRefusedWhereItIsDamaged) {
  SavvyCanReader reader;
  ASSERT_TRUE(std::holds_alternative<Remark>(reader.read("Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8")));
  for (const char* line : {"", "x,09F11223,true,Rx,0,1,FF", "1,39F11223,true,Rx,0,1,FF", "1,G,true,Rx,0,1,FF", "1,09F11223,maybe,Rx,0,1,FF",
                           "1,09F11223,true,Rx,256,1,FF", "1,09F11223,true,Rx,0,2,FF", "1,09F11223,true,Rx,0,1,100",
                           "1,800,false,Rx,0,1,FF", "1,09F11223,true,Rx,0,,FF"})
    EXPECT_TRUE(std::holds_alternative<std::string_view>(reader.read(line))) << line;
}

}  // namespace
}  // namespace earshot::hil
