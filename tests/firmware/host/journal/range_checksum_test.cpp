#include "firmware/host/journal/range_checksum.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/core/crc32.hpp"

namespace earshot::host {
namespace {

TEST(RangeChecksum, GivesThePublishedCheckValueWhateverStandsBeforeAndBehind) {
  constexpr std::string_view kText = "before123456789behind";
  const std::vector<std::uint8_t> bytes(kText.begin(), kText.end());
  RangeChecksum sums;
  EXPECT_EQ(sums.of(bytes, 6, 15), 0xCBF43926U);
}

TEST(RangeChecksum, OfEveryRangeIsThatOfItsBytesAloneAndGoesThroughEachOnce) {
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t i = 0; i < 300; ++i) bytes.push_back(static_cast<std::uint8_t>(i * i >> 3U));
  RangeChecksum sums;
  for (std::size_t begin = 0; begin < bytes.size(); ++begin)
    for (std::size_t end = begin; end <= bytes.size(); ++end)
      ASSERT_EQ(sums.of(bytes, begin, end), crc32(std::span(bytes).subspan(begin, end - begin))) << begin << " to " << end;
  EXPECT_EQ(sums.bytes_gone_through(), 300U);
}

TEST(RangeChecksum, KnowsNothingOfWhatItForgot) {
  const std::vector<std::uint8_t> one(10, 1);
  const std::vector<std::uint8_t> two(10, 2);
  RangeChecksum sums;
  (void)sums.of(one, 0, 10);
  sums.forget();
  EXPECT_EQ(sums.of(two, 3, 10), crc32(std::span(two).first(7)));
}

}  // namespace
}  // namespace earshot::host
