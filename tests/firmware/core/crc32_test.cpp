#include "firmware/core/crc32.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot {
namespace {

constexpr std::array<std::uint8_t, 9> kDigits = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

TEST(Crc32, GivesThePublishedCheckValue) {
  EXPECT_EQ(crc32(kDigits), 0xCBF43926U);  // the "check" of CRC-32/ISO-HDLC in Greg Cook's catalogue
}

TEST(Crc32, OfNoBytesIsZero) {
  EXPECT_EQ(crc32({}), 0U);
}

TEST(Crc32, OfTwoPartsGoneOnWithIsThatOfTheWhole) {
  const std::span whole(kDigits);
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) EXPECT_EQ(crc32(whole.subspan(cut), crc32(whole.first(cut))), crc32(whole)) << cut;
}

TEST(Crc32, ChangesWithEverySingleBit) {
  for (std::size_t bit = 0; bit < 8 * kDigits.size(); ++bit) {
    auto damaged = kDigits;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_NE(crc32(damaged), crc32(kDigits)) << bit;
  }
}

}  // namespace
}  // namespace earshot
