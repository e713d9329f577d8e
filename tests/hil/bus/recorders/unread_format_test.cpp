#include "hil/bus/recorders/unread_format.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

using namespace std::string_view_literals;

/// Whether what is said of it has this word.
bool is_named(std::string_view beginning, std::string_view word) {
  return unread_format(beginning).find(word) != std::string_view::npos;
}

// The first bytes of canboat's samples, and of formats by their own descriptions.
TEST(UnreadFormat, NamesWhatItIs) {
  EXPECT_TRUE(is_named("LOGG\x90\x00\x00\x00"sv, "BLF"));
  EXPECT_TRUE(is_named("MDF     4.10"sv, "MDF"));
  EXPECT_TRUE(is_named("\xD4\xC3\xB2\xA1\x02\x00\x04\x00"sv, "Wireshark"));
  EXPECT_TRUE(is_named("\x0A\x0D\x0D\x0A\x1C\x00"sv, "Wireshark"));
  EXPECT_TRUE(is_named("\x1F\x8B\x08\x00"sv, "compressed"));
  EXPECT_TRUE(is_named("\xFF\xFE(\x00"sv, "UTF-16"));
  EXPECT_TRUE(is_named("\x1B\x01\x07\x95\x0E\x28\x9A\x00\x01\xF8"sv, "EBL"));
  EXPECT_TRUE(is_named("\x03\x00\x10\xE7\xA7\x84\x83\xD9\x01\x1B\x01\x07"sv, "EBL"));
  EXPECT_TRUE(is_named("\x10\x03\x10\x02\x93\x13\x02\x12\xF1\x01\xFF\xCC\xB1\x5D\x0A\x00"sv, "NGT-1"));
  EXPECT_TRUE(is_named("timestamp,arbitration_id,extended,remote,error,dlc,data\n", "python-can"));
  EXPECT_TRUE(is_named("Sequence #,Timestamp,PGN,Name,Manufacturer\n", "Garmin"));
  EXPECT_TRUE(is_named("\n# a comment\r\n{\"pgn\":60928,\"payload\":[147]}\n", "JSON"));
  EXPECT_TRUE(is_named("!PDGY,129039,4,43,255,481.706,ErZcAw6BGlf/\n", "iKonvert"));
  EXPECT_TRUE(is_named("$PCDIN,01F112,000C72EA,09,28C36A0000B40AFD*56\n", "PCDIN"));
  EXPECT_TRUE(is_named("A000057.055 09FF7 0FF00 3F9FDCFFFFFFFFFF\n", "N2K ASCII"));
  EXPECT_TRUE(is_named("$GPGGA,123519,4807.038,N\n", "NMEA 0183"));
  EXPECT_TRUE(is_named("2020-03-04T00:29:58.617 2  13 255 130306 Wind Data:  SID = Unknown\n", "decoded already"));
}

TEST(UnreadFormat, IsNoneOfALogThatIsRead) {
  for (const std::string_view beginning :
       {""sv, "# a comment"sv, "(1436509052.249713) can0 09F8017F#50C3B81347D82BC6\n"sv,
        "17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD\n"sv, "2011-04-25-10:16:43.004,2,127250,3,255,8,ff,8b,0a,ff,7f,ff,7f,fd\n"sv,
        ";$FILEVERSION=1.1\n"sv, "date Tue Nov 14 22:13:20 2023\n"sv, "Time Stamp,ID,Extended,Dir,Bus,LEN\n"sv,
        "<0x18eeff01> [8] 05 a0 be 1c 00 a0 a0 c0\n"sv, "\0\0\0\0"sv, "x y z\n"sv, "  can0  123   [0]\n"sv})
    EXPECT_EQ(unread_format(beginning), "") << beginning;
}

}  // namespace
}  // namespace earshot::hil
