#include "firmware/wire/n2k/signals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "firmware/wire/n2k/fast_packet.hpp"
#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::n2k {
namespace {

const Signal& signal(std::uint32_t pgn, std::string_view name) {
  return *find_signal(*find_message(pgn), FieldName(name));
}

/// The bytes of a recorded message, fast packets put together.
std::vector<std::uint8_t> bytes_of(const Recorded& recorded) {
  if (recorded.frames.size() == 1) return {recorded.frames[0].bytes().begin(), recorded.frames[0].bytes().end()};
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  Status status = Status::kNotReady;
  for (const Frame& frame : recorded.frames) status = assembly.accept(parse_identifier(frame.identifier).value(), frame, bytes);
  EXPECT_EQ(status, Status::kOk);
  return {bytes.begin(), bytes.end()};
}

TEST(Signals, ReadWhatCanboatReadsOnARecordedBus) {
  std::set<std::uint32_t> seen;
  for (const Recorded& recorded : recorded_bus()) {
    seen.insert(recorded.pgn);
    const Message* message = find_message(recorded.pgn);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(recorded.fields.size(), message->signals.size());
    for (const auto& [name, value] : recorded.fields) {
      const Signal* found = find_signal(*message, FieldName(name));
      ASSERT_NE(found, nullptr) << name;
      const Result<double> decoded = decode(*found, bytes_of(recorded));
      if (value) {
        ASSERT_TRUE(decoded.ok()) << name;
        EXPECT_EQ(decoded.value(), *value) << name;
      } else {
        EXPECT_EQ(decoded.status(), Status::kNotReady) << name;
      }
    }
  }
  EXPECT_EQ(seen, (std::set{kRequestPgn, kAddressClaimPgn, kHeadingControlPgn, kRudderPgn, kHeadingPgn, kRateOfTurnPgn, kAttitudePgn,
                            kSpeedPgn, kWaterDepthPgn, kDistanceLogPgn, kPositionPgn, kCoursePgn, kWindPgn}));
}

TEST(Signals, WriteTheRecordedFramesBitForBit) {
  for (const Recorded& recorded : recorded_bus()) {
    const Message& message = *find_message(recorded.pgn);
    const std::vector<std::uint8_t> expected = bytes_of(recorded);
    std::vector<std::uint8_t> bytes = expected;  // for its reserved bits, which some devices leave zero
    for (const Signal& s : message.signals) detail::write_bits(bytes, s, static_cast<std::uint64_t>(not_available(s)));
    for (const auto& [name, value] : recorded.fields) {
      if (value) {
        ASSERT_EQ(encode(*find_signal(message, FieldName(name)), *value, bytes), Status::kOk) << name;
      }
    }
    EXPECT_EQ(bytes, expected) << recorded.pgn;
  }
}

TEST(Signals, ReadAPressureFrameLaidOutByHand) {
  // 30 bar and 5.3 Pa over the air: 3000005.3 Pa = 30000053 * 0.1 = 0x01C9C3B5.
  const std::array<std::uint8_t, 8> bytes{0xFF, 0x00, 0x01, 0xB5, 0xC3, 0xC9, 0x01, 0xFF};
  EXPECT_DOUBLE_EQ(decode(signal(kPressurePgn, "Pressure"), bytes).value(), 3'000'005.3);
  EXPECT_EQ(decode(signal(kPressurePgn, "Source"), bytes).value(), 1.0);
}

TEST(Signals, TellNotAvailableFromErrorAndReserved) {
  const Signal& heading = signal(kHeadingPgn, "Heading");
  const auto with = [](std::uint8_t low, std::uint8_t high) {
    return std::array<std::uint8_t, 8>{0xFF, low, high, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD};
  };
  EXPECT_EQ(decode(heading, with(0xFF, 0xFF)).status(), Status::kNotReady);
  EXPECT_EQ(decode(heading, with(0xFE, 0xFF)).status(), Status::kOutOfRange);
  EXPECT_EQ(decode(heading, with(0xFD, 0xFF)).status(), Status::kOutOfRange);
  EXPECT_EQ(decode(heading, with(0x71, 0xF5)).status(), Status::kOutOfRange) << "62833 * 1e-4 rad is more than a turn";
  EXPECT_TRUE(decode(heading, with(0x70, 0xF5)).ok()) << "62832 * 1e-4 rad is a turn, rounded";
  const Signal& latitude = signal(kPositionPgn, "Latitude");
  EXPECT_EQ(decode(latitude, std::array<std::uint8_t, 4>{0xFF, 0xFF, 0xFF, 0x7F}).status(), Status::kNotReady);
  EXPECT_EQ(decode(latitude, std::array<std::uint8_t, 4>{0xFE, 0xFF, 0xFF, 0x7F}).status(), Status::kOutOfRange);
  EXPECT_EQ(decode(latitude, std::array<std::uint8_t, 4>{0x00, 0x00, 0x00, 0x80}).status(), Status::kOutOfRange);
  EXPECT_EQ(decode(latitude, std::array<std::uint8_t, 4>{0x01, 0xE9, 0xA4, 0x35}).status(), Status::kOutOfRange)
      << "a latitude of 90.0000001 degrees";
}

TEST(Signals, RefuseToReadFromTooFewBytesAndToWriteIntoThem) {
  std::array<std::uint8_t, 2> two{};
  EXPECT_EQ(decode(signal(kHeadingPgn, "Heading"), two).status(), Status::kMalformed);
  EXPECT_EQ(encode(signal(kHeadingPgn, "Heading"), 1.0, two), Status::kFull);
}

TEST(Signals, LeaveTheBytesAloneWhenTheValueIsRefused) {
  auto bytes = blank(*find_message(kSpeedPgn));
  const auto before = bytes;
  const Signal& speed = signal(kSpeedPgn, "SpeedWaterReferenced");
  for (const double value : {-0.01, 655.33, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(encode(speed, value, bytes), Status::kOutOfRange) << value;
    EXPECT_EQ(bytes, before);
  }
}

TEST(Signals, GiveBackEveryValueToHalfAStepOfTheirScale) {
  for (const Message& message : messages()) {
    for (const Signal& s : message.signals) {
      if (s.kind != Signal::Kind::kNumber) continue;
      for (int i = 0; i <= 1000; ++i) {
        const double value = std::min(s.highest, s.lowest + (s.highest - s.lowest) * i / 1000.0);
        auto bytes = blank(message);
        ASSERT_EQ(encode(s, value, bytes), Status::kOk) << message.name << ' ' << s.name << ' ' << value;
        const Result<double> decoded = decode(s, bytes);
        ASSERT_TRUE(decoded.ok()) << message.name << ' ' << s.name << ' ' << value;
        // Rounding to the nearest raw value; of 64 bits, to those that a double can tell apart.
        ASSERT_NEAR(decoded.value(), value, s.scale.numerator / s.scale.denominator * 0.5000001 + 4e-16 * std::abs(value)) << s.name;
      }
    }
  }
}

TEST(Signals, DoNotTouchTheirNeighbours) {
  for (const Message& message : messages()) {
    for (const Signal& s : message.signals) {
      if (s.kind != Signal::Kind::kNumber) continue;
      auto bytes = blank(message);
      ASSERT_EQ(encode(s, s.lowest, bytes), Status::kOk);
      for (const Signal& other : message.signals) {
        if (other.name == s.name || other.kind != Signal::Kind::kNumber) continue;
        if (special_values(other) == 0) {
          EXPECT_EQ(decode_raw(other, bytes).value(), not_available(other)) << message.name << ' ' << other.name;
          continue;
        }
        EXPECT_EQ(decode(other, bytes).status(), Status::kNotReady) << message.name << ' ' << s.name << ' ' << other.name;
      }
    }
  }
}

TEST(Messages, ThatShareAGroupAreToldApartByTheirKind) {
  EXPECT_EQ(find_message(kPeerPgn, 1)->name, "EarshotCommand");
  EXPECT_EQ(find_message(kPeerPgn, 2)->name, "EarshotCommandAcknowledgement");
  EXPECT_EQ(find_message(kPeerPgn, 3)->name, "EarshotAbort");
  EXPECT_EQ(find_message(kPeerPgn)->name, "EarshotCommand") << "the first of them";
  EXPECT_EQ(find_message(kPeerPgn, 4), nullptr);
  EXPECT_EQ(find_message(kHeadingPgn, 1), nullptr);
  EXPECT_EQ(find_message(1), nullptr);
  EXPECT_EQ(find_signal(*find_message(kHeadingPgn), "Hedding"), nullptr);
}

TEST(Messages, AreTooOldAfterTenPeriodsAndGiveWayAfterTwoAndAHalf) {
  EXPECT_EQ(table::kHeading.period, Duration::seconds(1));
  EXPECT_EQ(table::kHeading.timeout, Duration::seconds(10));
  EXPECT_EQ(table::kHeading.handover, Duration::milliseconds(2500));
  EXPECT_EQ(table::kBattery.handover, Duration::milliseconds(3750));
}

TEST(Signals, AreRoundedToTheNearestStepOnBothSidesOfZero) {
  const Signal& variation = signal(kVariationPgn, "Variation");  // 1e-4 rad, bytes 4 and 5
  for (const auto& [value, raw] : {std::pair{0.00016, 2}, {0.00014, 1}, {-0.00016, -2}, {-0.00014, -1}}) {
    auto bytes = blank(*find_message(kVariationPgn));
    ASSERT_EQ(encode(variation, value, bytes), Status::kOk);
    EXPECT_EQ(decode_raw(variation, bytes).value(), raw) << value;
  }
}

TEST(Signals, KeepAllSixtyFourBitsOfALatitude) {
  // 46.0008433123456789 degrees: 460008433123456789 * 1e-16, beyond 2^53, whose neighbours no double can tell apart.
  const Signal& latitude = signal(kGnssPgn, "Latitude");
  auto bytes = blank(*find_message(kGnssPgn));
  ASSERT_EQ(encode_raw(latitude, 460'008'433'123'456'789, bytes), Status::kOk);
  // 0x0662473B9201F715 from below, in bytes 7 to 14.
  const std::array<std::uint8_t, 8> expected{0x15, 0xF7, 0x01, 0x92, 0x3B, 0x47, 0x62, 0x06};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), bytes.begin() + 7));
  EXPECT_EQ(decode_raw(latitude, bytes).value(), 460'008'433'123'456'789);
  EXPECT_NEAR(decode(latitude, bytes).value(), 46.0008433123456789, 1.5e-14);  // two roundings: 7.1e-15 degree is a double's step at 46
  ASSERT_EQ(encode_raw(latitude, -900'000'000'000'000'000, bytes), Status::kOk);
  EXPECT_EQ(decode(latitude, bytes).value(), -90.0);
  EXPECT_EQ(encode_raw(latitude, 900'000'000'000'000'001, bytes), Status::kOutOfRange);
}

TEST(Signals, KnowTheEndsOfSixtyFourBits) {
  const Signal& altitude = signal(kGnssPgn, "Altitude");
  auto bytes = blank(*find_message(kGnssPgn));
  EXPECT_EQ(decode(altitude, bytes).status(), Status::kNotReady);
  constexpr std::int64_t kTop = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(encode_raw(altitude, kTop - 2, bytes), Status::kOutOfRange);
  ASSERT_EQ(encode_raw(altitude, kTop - 3, bytes), Status::kOk);
  EXPECT_EQ(decode_raw(altitude, bytes).value(), kTop - 3);
  detail::write_bits(bytes, altitude, static_cast<std::uint64_t>(kTop - 1));
  EXPECT_EQ(decode_raw(altitude, bytes).status(), Status::kOutOfRange);
  EXPECT_EQ(encode(altitude, 9.3e12, bytes), Status::kOutOfRange);
}

TEST(Signals, TakeEveryRawValueOfAFieldWithoutSpecialOnes) {
  const Signal& instance = signal(kAddressClaimPgn, "DeviceInstanceLower");
  std::array<std::uint8_t, 8> bytes{};
  for (std::int64_t raw = 0; raw < 8; ++raw) {
    ASSERT_EQ(encode_raw(instance, raw, bytes), Status::kOk);
    EXPECT_EQ(decode_raw(instance, bytes).value(), raw);
  }
}

TEST(Signals, GiveBackEveryRawValueByWayOfItsNumber) {
  std::mt19937_64 random(15);
  for (const Message& message : messages()) {
    for (const Signal& s : message.signals) {
      if (s.kind != Signal::Kind::kNumber) continue;
      for (int i = 0; i < 300; ++i) {
        const auto span = static_cast<std::uint64_t>(s.highest_raw) - static_cast<std::uint64_t>(s.lowest_raw);
        const std::int64_t raw = i < 2 ? (i == 0 ? s.lowest_raw : s.highest_raw)
                                       : static_cast<std::int64_t>(static_cast<std::uint64_t>(s.lowest_raw) + random() % span);
        auto bytes = blank(message);
        ASSERT_EQ(encode_raw(s, raw, bytes), Status::kOk);
        ASSERT_EQ(decode_raw(s, bytes).value(), raw) << message.name << ' ' << s.name;
        auto again = blank(message);
        if (s.bit_count > 53) continue;  // a double does not hold them all
        const double value = std::clamp(decode(s, bytes).value(), s.lowest, s.highest);
        ASSERT_EQ(encode(s, value, again), Status::kOk);
        ASSERT_EQ(again, bytes) << message.name << ' ' << s.name << ' ' << raw;
      }
    }
  }
}

}  // namespace
}  // namespace earshot::n2k
