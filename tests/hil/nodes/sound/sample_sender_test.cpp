#include "hil/nodes/sound/sample_sender.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"
#include "hil/nodes/scaled_clock.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::hil {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.68:7668?ttl=0";

class SampleSenderTest : public testing::Test {
 protected:
  void SetUp() override { ENTER_PRIVATE_NETWORK_OR_SKIP(); }

  static messages::HydrophoneBlock next_block(host::LcmEndpoint& endpoint) {
    for (wire::Lc02Message message;;) {
      wire::HydrophoneMessage heard;
      if (endpoint.take(message) == Status::kOk && wire::read_hydrophone_block(message.data, heard) == Status::kOk) return heard.block;
      pollfd ready{endpoint.file_descriptor(), POLLIN, 0};
      if (::poll(&ready, 1, 5000) != 1) return {};
      endpoint.collect();
    }
  }
};

TEST_F(SampleSenderTest, SendsItsBlocksOneBehindTheOtherDatedByTheWallClock) {
  host::LcmEndpoint receiver(host::parse_lcm_url(kUrl), {wire::kHydrophoneBlockChannel});
  const SampleSender sender(kUrl, 50.0, Decibels{10.0}, 1);
  for (std::int64_t i = 0; i < 4; ++i) {
    const messages::HydrophoneBlock block = next_block(receiver);
    EXPECT_EQ(block.sequence, i);
    EXPECT_EQ(block.first_sample, 125 * i);
    EXPECT_EQ(block.samples_per_channel, 125U);
    const Duration ago = ScaledClock::utc() - block.time;
    EXPECT_GE(ago, HydrophoneSamples::kBlock);
    EXPECT_LT(ago, Duration::seconds(4)) << "on a busy machine";
  }
}

TEST_F(SampleSenderTest, SendsFiftyTimesAsManyWhereItsTimeRunsSoFast) {
  host::LcmEndpoint receiver(host::parse_lcm_url(kUrl), {wire::kHydrophoneBlockChannel});
  const Time began = ScaledClock::host_now();
  const SampleSender sender(kUrl, 50.0, Decibels{10.0}, 1);
  for (int i = 0; i < 40; ++i) (void)next_block(receiver);
  EXPECT_GE(ScaledClock::host_now() - began, Duration::milliseconds(200)) << "no faster than its ADC: ten seconds of sound";
  EXPECT_LT(ScaledClock::host_now() - began, Duration::seconds(8)) << "which are not waited for";
}

TEST_F(SampleSenderTest, SendsNothingWhileItIsMute) {
  host::LcmEndpoint receiver(host::parse_lcm_url(kUrl), {wire::kHydrophoneBlockChannel});
  SampleSender sender(kUrl, 50.0, Decibels{10.0}, 1);
  (void)next_block(receiver);
  bool has_gap = false;
  for (int i = 0; i < 50 && !has_gap; ++i) {  // a sender that gets no processor for so long sends later what it was to leave out
    sender.disturb({.line = SoundLine::kWhole, .gain_error = {}, .is_mute = true});
    pollfd ready{receiver.file_descriptor(), POLLIN, 0};
    std::int64_t last = 0;
    while (::poll(&ready, 1, 100) == 1) last = next_block(receiver).first_sample;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // five seconds of sound
    sender.disturb({});
    has_gap = next_block(receiver).first_sample > last + 125;
  }
  EXPECT_TRUE(has_gap) << "the ADC went on";
}

}  // namespace
}  // namespace earshot::hil
