#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace earshot::n2k {
namespace {

constexpr Sender kSender{.source = 0x40, .sequence = 3};

/// The message that the frames carry.
std::vector<std::uint8_t> bytes_of(const FastPacketFrames& frames) {
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  Status status = Status::kNotReady;
  for (const Frame& frame : frames) status = assembly.accept({.pgn = kHealthPgn, .source = 0x40}, frame, bytes);
  EXPECT_EQ(status, Status::kOk);
  return {bytes.begin(), bytes.end()};
}

messages::Decision decision() {
  return {.step = 17,
          .time = Time{1'700'000'000'123'456},
          .position = {Meters{-12'345.67}, Meters{0.01}},
          .snr = Decibels{-7.5},
          .too_faint = true,
          .detected = false,
          .action = 5,
          .overridden = true,
          .waypoint = {Meters{1000}, Meters{-1000}},
          .belief = {}};
}

TEST(Reports, OfHealthComeBack) {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.end_reason = messages::EndReason::kSnrStale;
  health.steps_taken = 0xFFFF'FFFF;
  health.counters = {.navigation_refused = 1, .snr_refused = 2, .status_refused = 5, .commands_refused = 3, .setpoints_limited = 4};
  health.turn = 6;
  health.decisions = 7;
  health.authority = messages::Authority::kAbort;
  health.is_paused = true;
  health.is_sweeping = true;
  health.is_found = true;
  health.mismatch_bits = 13.5F;
  health.response = config::Response::kRelease;
  ASSERT_EQ(health.ports.push_back({}), Status::kOk);
  FastPacketFrames frames;
  ASSERT_EQ(compose_health(health, Time{-5}, kSender, frames), Status::kOk);
  EXPECT_EQ(frames.size(), 9U);  // 61 bytes: 6 and 7 times 7 and 6
  const Result<HealthReport> read = read_health(bytes_of(frames));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().time, Time{-5});
  EXPECT_EQ(read.value().health.state, messages::MissionState::kAbort);
  EXPECT_EQ(read.value().health.end_reason, messages::EndReason::kSnrStale);
  EXPECT_EQ(read.value().health.steps_taken, 0xFFFF'FFFFU);
  EXPECT_EQ(read.value().health.counters, health.counters);
  EXPECT_EQ(read.value().health.turn, 6U);
  EXPECT_EQ(read.value().health.decisions, 7U);
  EXPECT_EQ(read.value().health.authority, messages::Authority::kAbort);
  EXPECT_TRUE(read.value().health.is_paused);
  EXPECT_TRUE(read.value().health.is_sweeping);
  EXPECT_TRUE(read.value().health.is_found);
  EXPECT_EQ(read.value().health.mismatch_bits, 13.5F);
  EXPECT_EQ(read.value().health.response, config::Response::kRelease);
  EXPECT_EQ(read.value().port_count, 1);
}

TEST(Reports, OfTheHealthOfAnOlderVehicleComeBackWithoutWhatItDoesNotSay) {
  messages::Health health;
  health.steps_taken = 7;
  health.is_sweeping = health.is_found = true;
  health.mismatch_bits = 13.5F;
  health.response = config::Response::kHold;
  FastPacketFrames frames;
  ASSERT_EQ(compose_health(health, Time{5}, kSender, frames), Status::kOk);
  std::vector<std::uint8_t> bytes = bytes_of(frames);
  bytes.resize(58);    // what there was
  bytes[51] |= 0xC0U;  // reserved bits were ones
  const Result<HealthReport> read = read_health(bytes);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().health.steps_taken, 7U);
  EXPECT_FALSE(read.value().health.is_sweeping);
  EXPECT_FALSE(read.value().health.is_found);
  EXPECT_EQ(read.value().health.mismatch_bits, 0.0F);
  EXPECT_EQ(read.value().health.response, config::Response::kWarn);
}

TEST(Reports, OfHealthLeaveWhereTheyCanTheMismatchThatNoFieldHolds) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const auto told = [](float mismatch_bits) {
    messages::Health health;
    health.mismatch_bits = mismatch_bits;
    FastPacketFrames frames;
    EXPECT_EQ(compose_health(health, Time{5}, kSender, frames), Status::kOk);
    return read_health(bytes_of(frames)).value().health.mismatch_bits;
  };
  EXPECT_EQ(told(kInfinite), 655.32F) << "16 bits of hundredths, below reserved, out of range and not available";
  EXPECT_EQ(told(-1.0F), 0.0F);
  EXPECT_EQ(told(std::numeric_limits<float>::quiet_NaN()), 0.0F) << "not said";
}

TEST(Reports, OfHealthDoNotPassAnUnknownResponseForAnother) {
  FastPacketFrames frames;
  ASSERT_EQ(compose_health({}, Time{5}, kSender, frames), Status::kOk);
  std::vector<std::uint8_t> bytes = bytes_of(frames);
  bytes[58] = static_cast<std::uint8_t>(bytes[58] | 7U << 2U);  // one more than there is
  EXPECT_EQ(read_health(bytes).status(), Status::kUnsupported);
}

TEST(Reports, StopCountingWhereTheirFieldEnds) {
  messages::PortReport report;
  report.link_up = false;
  report.received = std::numeric_limits<std::uint64_t>::max();
  report.lost = 7;
  FastPacketFrames frames;
  ASSERT_EQ(compose_port_health(report, kSender, frames), Status::kOk);
  const Result<messages::PortReport> read = read_port_health(bytes_of(frames));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().received, (std::uint64_t{1} << 48U) - 4);  // below reserved, out of range and not available
  EXPECT_EQ(read.value().lost, 7U);
  EXPECT_FALSE(read.value().link_up);
}

TEST(Reports, LieByteForByteWhereOtherProgramsExpectThem) {
  using Bytes = std::vector<std::uint8_t>;
  FastPacketFrames frames;
  messages::Health health;
  health.state = messages::MissionState::kAbort;         // 3
  health.end_reason = messages::EndReason::kTimeUsedUp;  // 7
  health.steps_taken = 0x04030201;
  health.counters = {.navigation_refused = 0x060504030201,
                     .snr_refused = 0x161514131211,
                     .status_refused = 0x464544434241,
                     .commands_refused = 0x262524232221,
                     .setpoints_limited = 0x363534333231};
  health.turn = 0x565554535251;
  health.decisions = 0x64636261;
  health.authority = messages::Authority::kAbort;  // 4, below paused (1) and sweeping (0) in two bits each: 0001'0100
  health.is_paused = true;
  health.is_found = true;                        // 1, below the response in six bits: 0001'1001
  health.response = config::Response::kRelease;  // 6
  health.mismatch_bits = 47.87F;                 // 4787 is 0x12B3
  ASSERT_EQ(compose_health(health, Time{0x0807060504030201}, kSender, frames), Status::kOk);
  EXPECT_EQ(bytes_of(frames), (Bytes{0xFC, 0x9F, 1,    2,    3,    4,    5,    6,    7,    8,    3,    7,    1,    2,    3,    4,
                                     1,    2,    3,    4,    5,    6,    0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x21, 0x22, 0x23, 0x24,
                                     0x25, 0x26, 0x31, 0x32, 0x33, 0x34, 0x35, 0x36, 0,    0x51, 0x52, 0x53, 0x54, 0x55, 0x56, 0x61,
                                     0x62, 0x63, 0x64, 0x14, 0x41, 0x42, 0x43, 0x44, 0x45, 0x46, 0x19, 0xB3, 0x12}));

  // The link in two bits below six ones: 1 for up.
  const messages::PortReport report{.port = 9,
                                    .link_up = true,
                                    .received = 0x060504030201,
                                    .lost = 0x161514131211,
                                    .malformed = 0x262524232221,
                                    .unsent = 0x363534333231};
  ASSERT_EQ(compose_port_health(report, kSender, frames), Status::kOk);
  EXPECT_EQ(bytes_of(frames), (Bytes{0xFC, 0x9F, 9,    0xFD, 1,    2,    3,    4,    5,    6,    0x11, 0x12, 0x13, 0x14,
                                     0x15, 0x16, 0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0x31, 0x32, 0x33, 0x34, 0x35, 0x36}));

  // Places in centimetres: 0x01020304 is 16909060. SNR -7.50 dB: -750 in 18 bits is 0x3FD12; above it too faint 1, detected 0, overridden 1
  // in two bits each: 0100'01'11 with the highest two bits of the SNR. 0.25 of 60000 is 15000 = 0x3A98; 12.5 cells are 1250 = 0x04E2.
  messages::Decision sent = decision();
  sent.time = Time{0x0807060504030201};
  sent.step = 0x04030201;
  sent.position = {Meters{169'090.60}, Meters{-0.02}};
  sent.waypoint = {Meters{0.01}, Meters{0.02}};
  sent.belief = {.likeliest = {Meters{0.03}, Meters{0.04}},
                 .mean = {Meters{0.05}, Meters{0.06}},
                 .spread = Meters{0.07},
                 .likeliest_share = 0.25F,
                 .effective_cells = 12.5F};
  ASSERT_EQ(compose_decision(sent, kSender, frames), Status::kOk);
  EXPECT_EQ(bytes_of(frames), (Bytes{0xFC, 0x9F, 1,    2,    3,    4, 5, 6, 7, 8, 1, 2, 3, 4, 4,    3,    2,    1, 0xFE, 0xFF,
                                     0xFF, 0xFF, 0x12, 0xFD, 0x47, 5, 1, 0, 0, 0, 2, 0, 0, 0, 3,    0,    0,    0, 4,    0,
                                     0,    0,    5,    0,    0,    0, 6, 0, 0, 0, 7, 0, 0, 0, 0x98, 0x3A, 0xE2, 4, 0,    0}));
}

TEST(Reports, OfAPortComeBack) {
  const messages::PortReport report{.port = 3, .link_up = true, .received = 1, .lost = 2, .malformed = 4, .unsent = 5};
  FastPacketFrames frames;
  ASSERT_EQ(compose_port_health(report, kSender, frames), Status::kOk);
  std::vector<std::uint8_t> bytes = bytes_of(frames);
  EXPECT_EQ(read_port_health(bytes).value(), report);
  bytes[2] = 0xFF;
  EXPECT_EQ(read_port_health(bytes).status(), Status::kNotReady);
  bytes[0] = 0xFB;
  EXPECT_EQ(read_port_health(bytes).status(), Status::kUnsupported) << "another maker's";
}

TEST(Reports, GoToAllFromTheirSenderUnderTheirPacketsNumber) {
  // The source is the identifier's lowest byte; the sequence is in the highest three bits of a frame's first: 3 << 5 = 0x60.
  FastPacketFrames frames;
  ASSERT_EQ(compose_port_health({}, kSender, frames), Status::kOk);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].identifier & 0xFFU, 0x40U);
    EXPECT_EQ(frames[i].data[0], 0x60U | i);
  }
  ASSERT_EQ(compose_health({}, Time{0}, {.source = 0x41}, frames), Status::kOk);
  EXPECT_EQ(frames[0].identifier & 0xFFU, 0x41U);
  EXPECT_EQ(frames[0].data[0], 0);
}

TEST(Reports, OfADecisionWithHalfABeliefAreRefused) {
  messages::Decision sent = decision();
  sent.belief = {.likeliest = {Meters{500}, Meters{250}},
                 .mean = {Meters{-0.5}, Meters{0.25}},
                 .spread = Meters{1234.5},
                 .likeliest_share = 0.25F,
                 .effective_cells = 12.5F};
  FastPacketFrames frames;
  ASSERT_EQ(compose_decision(sent, kSender, frames), Status::kOk);
  std::vector<std::uint8_t> bytes = bytes_of(frames);
  ASSERT_EQ(bytes.size(), 60U);
  bytes[54] = bytes[55] = 0xFF;  // the likeliest share, bits 432 to 447
  EXPECT_EQ(read_decision(bytes).status(), Status::kNotReady);
}

TEST(Reports, OfADecisionComeBackToTheirResolution) {
  FastPacketFrames frames;
  for (const bool believes : {false, true}) {
    messages::Decision sent = decision();
    if (believes) {
      sent.belief = {.likeliest = {Meters{500}, Meters{250}},
                     .mean = {Meters{-0.5}, Meters{0.25}},
                     .spread = Meters{1234.5},
                     .likeliest_share = 0.25F,
                     .effective_cells = 12.5F};
    }
    ASSERT_EQ(compose_decision(sent, kSender, frames), Status::kOk);
    const Result<messages::Decision> read = read_decision(bytes_of(frames));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value().time, sent.time);
    EXPECT_EQ(read.value().step, 17U);
    EXPECT_EQ(read.value().position, sent.position);
    EXPECT_EQ(read.value().snr, sent.snr);
    EXPECT_TRUE(read.value().too_faint);
    EXPECT_FALSE(read.value().detected);
    EXPECT_TRUE(read.value().overridden);
    EXPECT_EQ(read.value().action, 5);
    EXPECT_EQ(read.value().waypoint, sent.waypoint);
    ASSERT_EQ(read.value().belief.has_value(), believes);
    if (believes) {
      EXPECT_EQ(read.value().belief->likeliest, sent.belief->likeliest);
      EXPECT_EQ(read.value().belief->mean, sent.belief->mean);
      EXPECT_EQ(read.value().belief->spread, sent.belief->spread);
      EXPECT_EQ(read.value().belief->likeliest_share, 0.25F);
      EXPECT_EQ(read.value().belief->effective_cells, 12.5F);
    }
  }
}

TEST(Reports, AreRefusedWhenNoFieldCanHoldThem) {
  FastPacketFrames frames;
  messages::Decision bad = decision();
  bad.position.north = Meters{3e7};
  EXPECT_EQ(compose_decision(bad, kSender, frames), Status::kOutOfRange);
  bad = decision();
  bad.snr = Decibels{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(compose_decision(bad, kSender, frames), Status::kOutOfRange);
  const std::vector<std::uint8_t> nothing(60, 0xFF);
  EXPECT_EQ(read_decision(nothing).status(), Status::kUnsupported);
  EXPECT_EQ(read_health({}).status(), Status::kUnsupported);
}

TEST(Reports, OfAStateThatNobodyKnowsAreRefused) {
  FastPacketFrames frames;
  ASSERT_EQ(compose_health({}, Time{0}, kSender, frames), Status::kOk);
  std::vector<std::uint8_t> bytes = bytes_of(frames);
  bytes[10] = 4;
  EXPECT_EQ(read_health(bytes).status(), Status::kUnsupported);
  bytes[10] = 0xFF;
  EXPECT_EQ(read_health(bytes).status(), Status::kNotReady);
}

}  // namespace
}  // namespace earshot::n2k
