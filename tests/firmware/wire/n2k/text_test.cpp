#include "firmware/wire/n2k/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {
namespace {

constexpr Signal kModel = table::field(table::kProduct, "ModelID");

std::vector<std::uint8_t> bytes_of(const std::string& text, char padding) {
  std::vector<std::uint8_t> bytes(134, 0x55);
  std::string field = text + std::string(32 - text.size(), padding);
  std::ranges::copy(field, bytes.begin() + 4);
  return bytes;
}

TEST(Text, LosesThePaddingOfEveryMaker) {
  for (const char padding : {'\xFF', '\0', ' ', '@'}) EXPECT_EQ(fixed_text(kModel, bytes_of("ST 70", padding)).value(), "ST 70");
  EXPECT_EQ(fixed_text(kModel, bytes_of("", '\xFF')).status(), Status::kNotReady);
  EXPECT_EQ(fixed_text(kModel, bytes_of(std::string(32, 'x'), ' ')).value(), std::string(32, 'x'));
}

TEST(Text, IsWrittenIntoItsFieldAndNoFurther) {
  std::vector<std::uint8_t> bytes(134, 0x55);
  ASSERT_EQ(write_fixed_text(kModel, "Earshot", bytes), Status::kOk);
  EXPECT_EQ(bytes, [] {
    std::vector<std::uint8_t> expected = bytes_of("Earshot", '\xFF');
    return expected;
  }());
  EXPECT_EQ(write_fixed_text(kModel, std::string(33, 'x'), bytes), Status::kOutOfRange);
  EXPECT_EQ(write_fixed_text(kModel, "caf\xE9", bytes), Status::kOutOfRange);
  EXPECT_EQ(fixed_text(kModel, bytes).value(), "Earshot");
  EXPECT_EQ(fixed_text(kModel, std::span(bytes).first(35)).status(), Status::kMalformed);
}

TEST(Text, MayEndWithTheBytesThatHoldIt) {
  std::vector<std::uint8_t> bytes(36, 0x55);
  ASSERT_EQ(write_fixed_text(kModel, std::string(32, 'x'), bytes), Status::kOk);
  EXPECT_EQ(fixed_text(kModel, bytes).value(), std::string(32, 'x'));
  EXPECT_EQ(write_fixed_text(kModel, "x", std::span(bytes).first(35)), Status::kFull);
  constexpr Signal kNumber = table::field(table::kProduct, "ProductCode");
  EXPECT_EQ(write_fixed_text(kNumber, "x", bytes), Status::kFull) << "a field of a number";
  EXPECT_EQ(fixed_text(kNumber, bytes).status(), Status::kMalformed);
}

TEST(Text, IsPrintableFromBlankToTilde) {
  std::vector<std::uint8_t> bytes(36);
  EXPECT_EQ(write_fixed_text(kModel, "a b~", bytes), Status::kOk);
  EXPECT_EQ(fixed_text(kModel, bytes).value(), "a b~");
  EXPECT_EQ(write_fixed_text(kModel, "\x1F", bytes), Status::kOutOfRange);
  EXPECT_EQ(write_fixed_text(kModel, "\x7F", bytes), Status::kOutOfRange);
  std::span<std::uint8_t> room = bytes;
  EXPECT_EQ(put_variable_text("\x7F", room), Status::kOutOfRange);
}

TEST(Text, OfVariableSizeHasAtMost253Characters) {
  std::vector<std::uint8_t> bytes(300);
  std::span<std::uint8_t> room = bytes;
  EXPECT_EQ(put_variable_text(std::string(254, 'x'), room), Status::kOutOfRange);
  ASSERT_EQ(put_variable_text(std::string(253, 'x'), room), Status::kOk);
  EXPECT_EQ(bytes[0], 255) << "with its size and its encoding";
  EXPECT_EQ(room.size(), 45U);
  std::span<const std::uint8_t> rest = bytes;
  EXPECT_EQ(take_variable_text(rest).value(), std::string(253, 'x'));
}

TEST(Text, OfVariableSizeFollowsText) {
  // Size (with itself and the encoding), encoding 1, characters.
  const std::vector<std::uint8_t> bytes{5, 1, 'b', 'o', 'w', 2, 1, 4, 1, 'o', 'k'};
  std::span<const std::uint8_t> rest = bytes;
  EXPECT_EQ(take_variable_text(rest).value(), "bow");
  EXPECT_EQ(take_variable_text(rest).status(), Status::kNotReady);
  EXPECT_EQ(take_variable_text(rest).value(), "ok");
  EXPECT_TRUE(rest.empty());
  EXPECT_EQ(take_variable_text(rest).status(), Status::kMalformed);

  std::vector<std::uint8_t> written(11);
  std::span<std::uint8_t> room = written;
  EXPECT_EQ(put_variable_text("bow", room), Status::kOk);
  EXPECT_EQ(put_variable_text("", room), Status::kOk);
  EXPECT_EQ(put_variable_text("toolong", room), Status::kFull);
  EXPECT_EQ(put_variable_text("ok", room), Status::kOk);
  EXPECT_EQ(written, bytes);
}

TEST(Text, OfAnImpossibleSizeIsMalformed) {
  for (const std::uint8_t size : std::initializer_list<std::uint8_t>{0, 1, 6}) {
    const std::vector<std::uint8_t> bytes{size, 1, 'a', 'b'};
    std::span<const std::uint8_t> rest = bytes;
    EXPECT_EQ(take_variable_text(rest).status(), Status::kMalformed);
  }
  const std::vector<std::uint8_t> wide{4, 0, 'a', 'b'};
  std::span<const std::uint8_t> rest = wide;
  EXPECT_EQ(take_variable_text(rest).status(), Status::kUnsupported) << "two bytes a character";
}

}  // namespace
}  // namespace earshot::n2k
