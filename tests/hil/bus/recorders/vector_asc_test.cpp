#include "hil/bus/recorders/vector_asc.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <vector>

#include "tests/hil/bus/recorders/heading.hpp"

namespace earshot::hil {
namespace {

std::vector<LogEntry> asc_entries(const std::vector<const char*>& lines) {
  ::setenv("TZ", "UTC0", 1);
  ::tzset();
  VectorAscReader reader;
  std::vector<LogEntry> all;
  for (const char* const line : lines) {
    const LineOr read = reader.read(line);
    EXPECT_FALSE(std::holds_alternative<std::string_view>(read)) << line;
    if (std::holds_alternative<LogEntry>(read)) all.push_back(std::get<LogEntry>(read));
  }
  return all;
}

// What log2asc of can-utils and python-can 4.6.1 wrote. date -u -d @1700000000 gives Tue Nov 14 22:13:20 2023.
TEST(VectorAsc, IsReadAsOthersWriteIt) {
  const auto utils = asc_entries({"date Tue Nov 14 22:13:20 2023", "base hex  timestamps absolute", "no internal events logged",
                                  "0.000000 1  9F11223x        Rx   d 8 FF 70 5A FF 7F FF 7F FD",
                                  "0.000000 2  123             Rx   d 2 01 02", "0.151400 2  18EAFF44x       Rx   d 3 14 F0 01"});
  ASSERT_EQ(utils.size(), 3U);
  EXPECT_EQ(utils[0], (LogEntry{.time = Time{1'700'000'000'000'000}, .interface = "can0", .frame = kHeading}));
  EXPECT_FALSE(utils[1].frame);
  EXPECT_EQ(utils[2].time, Time{1'700'000'000'151'400});
  EXPECT_EQ(utils[2].interface, "can1");
  const auto python = asc_entries(
      {"date Sun Nov 29 08:21:37.422 2026", "base hex  timestamps absolute", "internal events logged",
       "Begin Triggerblock Tue Nov 14 22:13:20.48 2023", "0.000000 Start of measurement",
       "0.010600 1  9F11223x        Rx   d 8 FF 70 5A FF 7F FF 7F FD", "0.151400 2  18EAFF44x       Rx   r 3 ", "0.251400 1  ErrorFrame",
       "0.351400 CANFD   2 Rx   18EAFF44x                                   0 0 9 12 00 00 00 00 00 00 00 00 00 00 00 00 "
       "       0    0     1000        0        0        0        0        0",
       "End TriggerBlock"});
  ASSERT_EQ(python.size(), 4U);
  EXPECT_EQ(python[0], (LogEntry{.time = Time{1'700'000'000'490'600}, .interface = "can0", .frame = kHeading}));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_FALSE(python[i].frame) << i;
}

// Lines as Vector's tools write them, by the description of asc2log.
TEST(VectorAsc, PassesOverWhatIsNoFrame) {
  EXPECT_TRUE(asc_entries({"// version 9.0.0", "0.015991 CAN 1 Status:chip status error passive - TxErr: 132 RxErr: 0",
                           "0.1 1  Statistic: D 0 R 0 XD 0 XR 0 E 0 O 0 B 0.00%", "0.2 SV: 1 0 1 ::Engine = 5", "0.3 Start of measurement",
                           "0.4 1  9F11223x        TxRq   d 8 FF 70 5A FF 7F FF 7F FD", "0.5 1 J1939TP FEE3p 6 0 0 - Rx d 39 20 22"})
                  .empty());
}

TEST(VectorAsc, ReadsDecimalNumbersAndStampsThatCountFromTheOneBefore) {
  const auto all = asc_entries({"base dec timestamps relative",
                                "0.500000 1 166793763x Rx d 8 255 112 90 255 127 255 127 253 Length = 239910 BitCount = 124",
                                "0.250000 1 166793763x Rx d 8 255 112 90 255 127 255 127 253"});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].frame, kHeading);
  EXPECT_EQ(all[1].time, Time{750'000});
}

// By asc2log: a classic frame has no FDF (0x1000) among its flags; a name may stand behind the identifier.
TEST(VectorAsc, ReadsClassicFramesThatAreWrittenAsCanFd) {
  const auto all = asc_entries({"1.0 CANFD 1 Rx 9F11223x 0 0 8 8 FF 70 5A FF 7F FF 7F FD 100000 214 0 80000000 0 0 0 0",
                                "1.0 CANFD 1 Rx 9F11223x VesselHeading 0 0 8 8 FF 70 5A FF 7F FF 7F FD 100000 214 0 80000000 0 0 0 0"});
  ASSERT_EQ(all.size(), 2U);
  for (const LogEntry& entry : all) EXPECT_EQ(entry.frame, kHeading);
}

TEST(VectorAsc, KnowsDatesOfHalfDaysAndOfGermans) {
  const auto begins = [](const char* date) { return asc_entries({date, "0.000000 1 9F11223x Rx d 0"}).at(0).time; };
  EXPECT_EQ(begins("date Tue Nov 14 10:13:20.500 pm 2023"), Time{1'700'000'000'500'000});
  EXPECT_EQ(begins("date Tue Nov 14 12:13:20 AM 2023"), Time{1'699'920'800'000'000});
  EXPECT_EQ(begins("date Don Dez 14 22:13:20 2023"), Time{1'702'592'000'000'000});
}

TEST(VectorAsc, IsRefusedWhereItIsDamaged) {
  VectorAscReader reader;
  ASSERT_TRUE(std::holds_alternative<Remark>(reader.read("base hex  timestamps absolute")));
  for (const char* line :
       {"date some day", "x 1 9F11223x Rx d 1 FF", "1 1 9F11223x Rx d 1 FF", "1.0 1 G9F11223x Rx d 1 FF", "1.0 1 39F11223x Rx d 1 FF",
        "1.0 1 9F11223x Rz d 1 FF", "1.0 1 9F11223x Rx e 1 FF", "1.0 1 9F11223x Rx d 2 FF", "1.0 1 9F11223x Rx d 1 100", "1.0",
        "1.0 999 9F11223x Rx d 1 FF", "1.0 CANFD 1 Rx 9F11223x 0 0 8 8 FF 70", "1.0 CANFD x"})
    EXPECT_TRUE(std::holds_alternative<std::string_view>(reader.read(line))) << line;
}

}  // namespace
}  // namespace earshot::hil
