#include "firmware/host/file/checksum_text.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

// The check value of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms.
TEST(ChecksumText, IsTheCheckValueOfTheNineDigits) {
  EXPECT_EQ(crc32_of("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32_of("6789", crc32_of("12345")), 0xCBF43926U);
}

TEST(ChecksumText, HasEightDigitsWhateverTheNumber) {
  EXPECT_EQ(crc32_text(0xCBF43926U), "cbf43926");
  EXPECT_EQ(crc32_text(0x2AU), "0000002a");
}

}  // namespace
}  // namespace earshot::host
