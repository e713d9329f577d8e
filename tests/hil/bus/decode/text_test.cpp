#include "hil/bus/decode/text.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::hil {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Every text of the bytes, one after the other; "-" for what is unreadable.
std::vector<std::string> texts(const Bytes& bytes) {
  std::vector<std::string> all;
  for (std::span<const std::uint8_t> rest = bytes; !rest.empty();) all.push_back(take_text(rest).value_or("-"));
  return all;
}

using Texts = std::vector<std::string>;

// Of canboat's pgn-test.in: 126998, whose second description is UTF-16.
TEST(TextOfABus, IsReadOfOneAndOfTwoBytesACharacter) {
  const Bytes hello{0x07, 0x01, 0x68, 0x65, 0x6C, 0x6C, 0x6F, 0x0C, 0x00, 0x77, 0x00, 0xF3, 0x00, 0x72, 0x00, 0x6C, 0x00, 0x64, 0x00};
  EXPECT_EQ(texts(hello), (Texts{"hello", "w\u00F3rld"}));
}

// Codes and their UTF-8 from the Unicode tables: U+20AC, U+1F40B (a whale: D83D DC0B), half of it alone, a mark of the order of bytes.
TEST(TextOfABus, KnowsAllOfUtf16) {
  EXPECT_EQ(texts({4, 0, 0xAC, 0x20}), Texts{"\xE2\x82\xAC"});
  EXPECT_EQ(texts({6, 0, 0x3D, 0xD8, 0x0B, 0xDC}), Texts{"\xF0\x9F\x90\x8B"});
  EXPECT_EQ(texts({6, 0, 0x3D, 0xD8, 'a', 0}), Texts{"\xEF\xBF\xBD"
                                                     "a"});
  EXPECT_EQ(texts({6, 0, 0xFF, 0xFE, 'a', 0}), Texts{"a"});
  EXPECT_EQ(texts({8, 0, 'a', 0, 0, 0, 'b', 0}), Texts{"a"});
  EXPECT_EQ(texts({6, 0, 'a', 0, 0xFF, 0xFF}), Texts{"a"});
  EXPECT_EQ(texts({5, 0, 'a', 0, 'b'}), Texts{"a"});
}

TEST(TextOfABus, OfAnUnknownEncodingDoesNotLoseTheNextOne) {
  EXPECT_EQ(texts({4, 2, 'a', 'b', 3, 1, 'c'}), (Texts{"-", "c"}));
  EXPECT_EQ(texts({2, 7, 2, 0, 2, 1}), (Texts{"", "", ""}));
  EXPECT_EQ(texts({5, 1, 'a', 0xFF, 0xFF, 3, 1, 'c'}), (Texts{"a", "c"}));
}

TEST(TextOfABus, WithASizeThatNoneHasEndsAll) {
  EXPECT_EQ(texts({9, 1, 'a', 'b'}), Texts{"-"});
  EXPECT_EQ(texts({1, 1, 'a', 'b'}), Texts{"-"});
  EXPECT_EQ(texts({0, 3, 1, 'c'}), Texts{"-"});
}

}  // namespace
}  // namespace earshot::hil
