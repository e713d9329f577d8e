#include <gtest/gtest.h>

#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "tests/firmware/wire/golden/every_message.hpp"
#include "tests/firmware/wire/golden/frames.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"

namespace earshot::wire {
namespace {

constexpr n2k::Sender kSender{.source = 0x40, .sequence = 3};
constexpr n2k::Route kRoute{.source = 0x41, .destination = 0x42, .sequence = 5};

TEST(CanGolden, EveryMessageHasTheFramesThatItAlwaysHad) {
  GoldenFile golden("can.txt");
  const auto fast = [&golden](std::string_view name, auto&& compose) {
    n2k::FastPacketFrames frames;
    ASSERT_EQ(compose(frames), Status::kOk) << name;
    golden.add(name, text_of(frames));
  };
  const auto single = [&golden](std::string_view name, auto&& compose) {
    n2k::Frame frame;
    ASSERT_EQ(compose(frame), Status::kOk) << name;
    golden.add(name, text_of(frame));
  };
  for (const bool has_all_fields : {false, true}) {
    fast(has_all_fields ? "health.all" : "health",
         [&](auto& frames) { return n2k::compose_health(sample_health(has_all_fields), kSampleTime, kSender, frames); });
    fast(has_all_fields ? "decision.all" : "decision",
         [&](auto& frames) { return n2k::compose_decision(sample_decision(has_all_fields), kSender, frames); });
    single(has_all_fields ? "autopilot_status.follows" : "autopilot_status", [&](n2k::Frame& frame) {
      return n2k::compose_autopilot_status(
          {.follows_setpoints = has_all_fields, .heading_sequence = has_all_fields ? std::optional<std::uint8_t>(6) : std::nullopt}, 0x43,
          frame);
    });
    single(has_all_fields ? "hydrophone_status.deaf" : "hydrophone_status",
           [&](n2k::Frame& frame) { return n2k::compose_deaf(has_all_fields, 0x43, frame); });
    single(has_all_fields ? "snr.too_faint" : "snr", [&](n2k::Frame& frame) {
      return n2k::compose_snr({.snr = Decibels{-7.25},
                               .too_faint = has_all_fields,
                               .band_level = has_all_fields ? std::optional<Decibels>(95.5) : std::nullopt},
                              0x43, frame);
    });
  }
  fast("port_report", [](auto& frames) { return n2k::compose_port_health(kSampleReport, kSender, frames); });
  fast("order", [](auto& frames) { return n2k::compose_command(sample_order(), kRoute, frames); });
  fast("order.tighten", [](auto& frames) { return n2k::compose_command(sample_tightening(), kRoute, frames); });
  fast("acknowledgement", [](auto& frames) { return n2k::compose_acknowledgement(kSampleAcknowledgement, kRoute, frames); });
  fast("challenge", [](auto& frames) { return n2k::compose_challenge(sample_challenge(), {.source = 0x41, .sequence = 5}, frames); });
  single("abort", [](n2k::Frame& frame) { return n2k::compose_abort(0x1234, 0x56789A, kRoute, frame); });
  single("hull", [](n2k::Frame& frame) { return n2k::compose_hull({.instance = 2, .wet = true, .has_ground_fault = false}, 0x43, frame); });
  single("altitude", [](n2k::Frame& frame) { return n2k::compose_altitude(Meters{20.5}, 0x43, frame); });
  n2k::SetpointFrames frames;
  ASSERT_EQ(n2k::compose_setpoint(kSampleSetpoint, 0x40, 2, frames), Status::kOk);
  golden.add("setpoint", text_of(frames));
  golden.expect_as_recorded();
}

}  // namespace
}  // namespace earshot::wire
