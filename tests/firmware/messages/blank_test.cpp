#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/hydrophone_block.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/sound_detection.hpp"

// What a message says that nobody has filled in, as one that is filled in by name leaves out what it has nothing to say about.
namespace earshot::messages {
namespace {

TEST(BlankMessage, OfADecisionClaimsNothing) {
  const Decision decision;
  EXPECT_EQ(decision.step, 0U);
  EXPECT_FALSE(decision.too_faint);
  EXPECT_FALSE(decision.detected);
  EXPECT_FALSE(decision.overridden);
  EXPECT_EQ(decision.action, 0);
  EXPECT_EQ(decision.observation_size, 0);
  EXPECT_EQ(decision.action_count, 0);
  EXPECT_EQ(std::ranges::count(decision.observation, 0.0F), 64);
  EXPECT_FALSE(decision.bearing);
  EXPECT_FALSE(decision.belief);
}

TEST(BlankMessage, OfABeliefIsSpreadOverNothing) {
  EXPECT_EQ(BeliefSummary{}.likeliest_share, 0.0F);
  EXPECT_EQ(BeliefSummary{}.effective_cells, 0.0F);
}

TEST(BlankMessage, OfHealthStandsByAndHasRefusedNothing) {
  const Health health;
  EXPECT_EQ(health.state, MissionState::kStandby);
  EXPECT_EQ(health.end_reason, EndReason::kNone);
  EXPECT_EQ(health.steps_taken, 0U);
  EXPECT_EQ(health.counters.navigation_refused, 0U);
  EXPECT_EQ(health.counters.snr_refused, 0U);
  EXPECT_EQ(health.counters.commands_refused, 0U);
  EXPECT_EQ(health.counters.setpoints_limited, 0U);
  EXPECT_EQ(health.counters.bearings_refused, 0U);
  EXPECT_EQ(health.counters.bearings_of_others, 0U);
  EXPECT_TRUE(health.ports.empty());
}

TEST(BlankMessage, OfAPortHasItsLinkAndHasCountedNothing) {
  const PortReport report;
  EXPECT_EQ(report.port, 0);
  EXPECT_TRUE(report.link_up);
  for (const std::uint64_t count : {report.received, report.lost, report.malformed, report.unsent}) EXPECT_EQ(count, 0U);
}

TEST(BlankMessage, OfAnOperatorOrdersTheVehicleToStop) {
  EXPECT_EQ(OperatorCommand{}.order, Order::kAbort);
  EXPECT_EQ(OperatorCommand{}.issuer, 0U);
  EXPECT_EQ(OperatorCommand{}.number, 0U);
  EXPECT_EQ(CommandAcknowledgement{}.order, Order::kAbort);
  EXPECT_EQ(CommandAcknowledgement{}.port, 0);
  EXPECT_EQ(CommandAcknowledgement{}.issuer, 0U);
  EXPECT_EQ(CommandAcknowledgement{}.number, 0U);
}

TEST(BlankMessage, OfAHydrophoneHasNoSamples) {
  const HydrophoneBlock block;
  EXPECT_EQ(block.sequence, 0);
  EXPECT_EQ(block.first_sample, 0);
  EXPECT_EQ(block.samples_per_channel, 0U);
  EXPECT_EQ(block.overflow_count, 0U);
  EXPECT_EQ(block.channels, 0);
}

TEST(BlankMessage, OfAnInputIsTheFirstOfTheFirstPort) {
  EXPECT_EQ(Input{}.port, 0);
  EXPECT_EQ(Input{}.sequence, 0U);
}

TEST(BlankMessage, OfABearingIsImpossible) {
  EXPECT_EQ(BearingMeasurement{}.sender, 0U);
  EXPECT_FALSE(BearingMeasurement{}.bearing.mirror_axis);
  EXPECT_FALSE(is_possible(Bearing{})) << "a deviation of nothing is none";
}

TEST(BlankMessage, OfASoundIsMeasuredAndNotClipped) {
  EXPECT_FALSE(SnrMeasurement{}.too_faint);
  EXPECT_FALSE(SoundDetection{}.is_clipped);
}

}  // namespace
}  // namespace earshot::messages
