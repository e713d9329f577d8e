#include "firmware/desk/journal_view/export/mcap_bytes.hpp"

#include <gtest/gtest.h>

namespace earshot::journal {
namespace {

TEST(McapBytes, AreLittleEndianAndTextStandsBehindItsLength) {
  McapBytes bytes;
  bytes.number(std::uint8_t{0x05}).number(std::uint16_t{0x0102}).number(std::uint64_t{0x8877665544332211}).text("ab").raw("c");
  EXPECT_EQ(bytes.bytes(), std::string("\x05\x02\x01\x11\x22\x33\x44\x55\x66\x77\x88\x02\0\0\0abc", 18));
}

}  // namespace
}  // namespace earshot::journal
