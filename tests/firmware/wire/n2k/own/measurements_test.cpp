#include "firmware/wire/n2k/own/measurements.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::n2k {
namespace {

constexpr std::uint8_t kSource = 0x40;

TEST(Measurements, AreLaidOutByteForByteAsTheTableSays) {
  Frame frame;
  ASSERT_EQ(compose_snr({.snr = Decibels{-3.25}, .too_faint = true, .band_level = Decibels{92.5}}, kSource, frame), Status::kOk);
  // 65291 = 0xFF0B at priority 5. Maker 2044, reserved ones, industry 4: 0x9FFC. Then from bit 0: SNR -325 in 18 bits 0x3FEBB, too faint 1
  // in 2, level 9250 = 0x2422 in 16, SID 0xFF, four ones: 0xFFF2422'7FEBB with the two bits at 18: 0x3FEBB | 1 << 18 = 0x7FEBB; 0x2422
  // << 20.
  EXPECT_EQ(frame, (Frame{0x14FF0B40, 8, {0xFC, 0x9F, 0xBB, 0xFE, 0x27, 0x42, 0xF2, 0xFF}}));
  ASSERT_EQ(compose_altitude(Meters{12.34}, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x14FF0C40, 8, {0xFC, 0x9F, 0xFF, 0xD2, 0x04, 0x00, 0x00, 0xFF}}));  // 1234 = 0x04D2
}

TEST(Measurements, ComeBack) {
  Frame frame;
  for (const double snr : {-600.0, -0.01, 0.0, 17.25, 600.0}) {
    ASSERT_EQ(compose_snr({.snr = Decibels{snr}, .too_faint = false, .band_level = {}}, kSource, frame), Status::kOk);
    const Result<HeardSnr> heard = read_snr(frame.bytes());
    ASSERT_TRUE(heard.ok());
    EXPECT_EQ(heard.value().snr.value, snr);
    EXPECT_FALSE(heard.value().too_faint);
    EXPECT_FALSE(heard.value().band_level.has_value());
    EXPECT_EQ(measurement_of(heard.value(), Time{5}).time, Time{5});
  }
  ASSERT_EQ(compose_altitude(Meters{12.34}, kSource, frame), Status::kOk);
  EXPECT_EQ(read_altitude(frame.bytes()).value().value, 12.34);
}

TEST(Measurements, OfOtherMakersAndWithoutAValueAreNotTaken) {
  Frame frame;
  EXPECT_EQ(compose_snr({.snr = Decibels{600.1}, .too_faint = false, .band_level = {}}, kSource, frame), Status::kOutOfRange);
  const std::array<std::uint8_t, 8> blank{0xFC, 0x9F, 0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFF};
  EXPECT_EQ(read_snr(blank).status(), Status::kNotReady);
  const std::array<std::uint8_t, 8> stranger{0xFB, 0x9F, 0xBB, 0xFE, 0x27, 0x42, 0xF2, 0xFF};
  EXPECT_EQ(read_snr(stranger).status(), Status::kUnsupported);
  EXPECT_EQ(read_altitude(stranger).status(), Status::kUnsupported);
  EXPECT_EQ(read_snr(std::span(stranger).first(1)).status(), Status::kUnsupported);
  EXPECT_EQ(read_altitude(std::array<std::uint8_t, 8>{0xFC, 0x9F, 2, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}).status(), Status::kNotReady);
}

TEST(Measurements, OfAnotherIndustryAreNotTakenThoughTheReservedBitsMaySayAnything) {
  // 12.34 m. Byte 1 from above: industry in three bits, two reserved ones, the highest three of the maker.
  std::array<std::uint8_t, 8> bytes{0xFC, 0x9F, 0xFF, 0xD2, 0x04, 0x00, 0x00, 0xFF};
  for (const std::uint8_t ours : {std::uint8_t{0x9F}, std::uint8_t{0x97}, std::uint8_t{0x8F}, std::uint8_t{0x87}}) {
    bytes[1] = ours;
    EXPECT_EQ(read_altitude(bytes).value().value, 12.34) << int{ours};
  }
  for (const unsigned industry : {0U, 1U, 2U, 3U, 5U, 6U, 7U}) {
    bytes[1] = static_cast<std::uint8_t>(0x1FU | (industry << 5U));
    EXPECT_EQ(read_altitude(bytes).status(), Status::kUnsupported) << industry;
    EXPECT_EQ(read_snr(bytes).status(), Status::kUnsupported) << industry;
  }
}

TEST(Measurements, OfAHydrophoneAreWhatTheRuntimeTakes) {
  Frame frame;
  ASSERT_EQ(compose_snr({.snr = Decibels{-3.25}, .too_faint = true, .band_level = Decibels{92.5}}, kSource, frame), Status::kOk);
  const HeardSnr heard = read_snr(frame.bytes()).value();
  EXPECT_EQ(heard.band_level->value, 92.5);
  EXPECT_EQ(measurement_of(heard, Time{5}).snr.value, -3.25);
  EXPECT_TRUE(measurement_of(heard, Time{5}).too_faint);
  HeardSnr unmarked;
  unmarked.snr = Decibels{-3.25};
  ASSERT_EQ(compose_snr(unmarked, kSource, frame), Status::kOk);
  EXPECT_FALSE(read_snr(frame.bytes()).value().too_faint) << "unless it says so";
}

}  // namespace
}  // namespace earshot::n2k
