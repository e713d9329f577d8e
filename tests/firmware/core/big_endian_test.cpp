#include "firmware/core/big_endian.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot {
namespace {

TEST(BigEndian, HasTheMostSignificantByteFirst) {
  std::array<std::uint8_t, 4> bytes{};
  store_big_endian(bytes, 0x01020304);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 4>{1, 2, 3, 4}));
  EXPECT_EQ(load_big_endian(bytes), 0x01020304U);
}

TEST(BigEndian, KeepsTheLastBytesOfANumberThatIsLonger) {
  std::array<std::uint8_t, 2> bytes{};
  store_big_endian(bytes, 0x01020304);
  EXPECT_EQ(load_big_endian(bytes), 0x0304U);
}

}  // namespace
}  // namespace earshot
