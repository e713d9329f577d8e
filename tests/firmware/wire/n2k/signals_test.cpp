#include "firmware/wire/n2k/signals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "firmware/wire/n2k/fast_packet.hpp"
#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::n2k {
namespace {

const Signal& signal(std::uint32_t pgn, std::string_view name) {
  return *find_signal(*find_message(pgn), name);
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
      const Signal* found = find_signal(*message, name);
      ASSERT_NE(found, nullptr) << name;
      const Result<double> decoded = decode(*found, bytes_of(recorded));
      if (value) {
        ASSERT_TRUE(decoded.ok()) << name;
        EXPECT_NEAR(decoded.value(), *value, 1e-12 * std::abs(*value)) << name;  // a rounding of raw * scale
      } else {
        EXPECT_EQ(decoded.status(), Status::kNotReady) << name;
      }
    }
  }
  EXPECT_EQ(seen, (std::set{kHeadingPgn, kSpeedPgn, kPositionPgn, kHeadingControlPgn}));
}

TEST(Signals, WriteTheRecordedFramesBitForBit) {
  for (const Recorded& recorded : recorded_bus()) {
    const Message& message = *find_message(recorded.pgn);
    auto bytes = blank(message);
    for (const auto& [name, value] : recorded.fields) {
      if (value) {
        ASSERT_EQ(encode(*find_signal(message, name), *value, bytes), Status::kOk) << name;
      }
    }
    EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + message.size), bytes_of(recorded)) << recorded.pgn;
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
      for (int i = 0; i <= 1000; ++i) {
        const double value = std::min(s.highest, s.lowest + (s.highest - s.lowest) * i / 1000.0);
        auto bytes = blank(message);
        ASSERT_EQ(encode(s, value, bytes), Status::kOk) << message.name << ' ' << s.name << ' ' << value;
        const Result<double> decoded = decode(s, bytes);
        ASSERT_TRUE(decoded.ok()) << message.name << ' ' << s.name << ' ' << value;
        ASSERT_NEAR(decoded.value(), value, s.scale * 0.5000001) << s.name;  // rounding to the nearest raw value
      }
    }
  }
}

TEST(Signals, DoNotTouchTheirNeighbours) {
  for (const Message& message : messages()) {
    for (const Signal& s : message.signals) {
      auto bytes = blank(message);
      ASSERT_EQ(encode(s, s.lowest, bytes), Status::kOk);
      for (const Signal& other : message.signals) {
        if (other.name == s.name) continue;
        EXPECT_EQ(decode(other, bytes).status(), Status::kNotReady) << message.name << ' ' << s.name << ' ' << other.name;
      }
    }
  }
}

}  // namespace
}  // namespace earshot::n2k
