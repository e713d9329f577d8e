#include "firmware/boards/linux/hydrophone/hydrophone_receiver.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "firmware/boards/linux/hydrophone/sample_meter.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::board {
namespace {

using namespace std::chrono_literals;

constexpr const char* kUrl = "udpm://239.255.76.68:7668?ttl=0";
constexpr std::uint64_t kDriverBlock = 1024;  ///< samples of each channel in the driver's blocks

/// Looks again and again for half a minute.
bool comes_true(const std::function<bool()>& what) {
  for (int i = 0; i < 3000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

class HydrophoneReceiverTest : public testing::Test {
 protected:
  void SetUp() override { ENTER_PRIVATE_NETWORK_OR_SKIP(); }
};

/// Hears nothing before it is let go, then everything.
class HeldSink final : public SampleSink {
 public:
  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) override {
    is_free_.wait(false);
    meter.hear(block, samples);
  }
  void let_go() {
    is_free_ = true;
    is_free_.notify_all();
  }

  SampleMeter meter;

 private:
  std::atomic<bool> is_free_{false};
};

/// So that a test that fails ends, too: a receiver waits for its sink.
struct LetGoAtTheEnd {
  HeldSink& sink;
  ~LetGoAtTheEnd() { sink.let_go(); }
};

/// Sends so many blocks, not faster than they are received.
void send(support::HydrophoneDriver& driver, const HydrophoneReceiver& receiver, std::uint64_t count) {
  constexpr std::uint64_t kAtOnce = 8;  // 256 kB: less than any kernel's buffer for a socket
  for (std::uint64_t i = 0; i < count; ++i) {
    ASSERT_TRUE(driver.send());
    if (i % kAtOnce != kAtOnce - 1) continue;
    ASSERT_TRUE(comes_true([&] {
      const HydrophoneReceiver::Counters counters = receiver.counters();
      return counters.blocks * kDriverBlock + counters.samples_overrun + kAtOnce / 2 * kDriverBlock >= driver.taken();
    }));
  }
}

TEST_F(HydrophoneReceiverTest, HearsEverySampleOfEightChannelsAtNinetySixKilohertzOrCountsIt) {
  SampleMeter meter;
  const HydrophoneReceiver receiver(kUrl, meter);
  support::HydrophoneDriver driver(kUrl, {});
  driver.send_in_time_for(2s);
  // What was lost last shows only when another block comes.
  ASSERT_TRUE(comes_true([&] {
    (void)driver.send();
    std::this_thread::sleep_for(50ms);
    const SampleMeter::Reading reading = meter.read();
    return reading.samples_heard + reading.samples_missing == driver.taken();
  }));
  EXPECT_GT(driver.taken(), 100'000U);
  EXPECT_EQ(meter.read().samples_heard, receiver.counters().blocks * kDriverBlock);
  EXPECT_EQ(receiver.counters().malformed, 0U);
  RecordProperty("samples_missing", std::to_string(meter.read().samples_missing));
}

TEST_F(HydrophoneReceiverTest, CountsEverySampleForWhichASlowSinksRingHadNoRoom) {
  HeldSink sink;
  HydrophoneReceiver receiver(kUrl, sink);
  const LetGoAtTheEnd release{sink};
  support::HydrophoneDriver driver(kUrl, {});
  constexpr std::uint64_t kHeld = 256;  // blocks of 8 x 1024 samples in a ring of 2^21; the sink gave none of them back
  constexpr std::uint64_t kTooMany = 40;
  send(driver, receiver, kHeld + kTooMany);
  ASSERT_TRUE(comes_true([&] { return receiver.counters().samples_overrun == kTooMany * kDriverBlock; }))
      << receiver.counters().samples_overrun;
  EXPECT_EQ(receiver.counters().blocks, kHeld);
  sink.let_go();
  ASSERT_TRUE(comes_true([&] { return sink.meter.read().samples_heard == kHeld * kDriverBlock; }));
  EXPECT_EQ(sink.meter.read().samples_missing, 0U) << "of what was lost last no block has told yet";
  send(driver, receiver, 1);
  ASSERT_TRUE(comes_true([&] { return sink.meter.read().samples_heard == (kHeld + 1) * kDriverBlock; }));
  EXPECT_EQ(sink.meter.read().samples_missing, kTooMany * kDriverBlock);
  EXPECT_EQ(sink.meter.read().missing_at_sender, 0U);
}

TEST_F(HydrophoneReceiverTest, LetsItsSinkHearAllThatWasReceivedBeforeItEnds) {
  HeldSink sink;
  auto receiver = std::make_unique<HydrophoneReceiver>(kUrl, sink);
  const LetGoAtTheEnd release{sink};
  support::HydrophoneDriver driver(kUrl, {});
  send(driver, *receiver, 96);
  ASSERT_TRUE(comes_true([&] { return receiver->counters().blocks == 96; }));
  sink.let_go();
  receiver.reset();
  EXPECT_EQ(sink.meter.read().samples_heard, 96 * kDriverBlock);
}

TEST_F(HydrophoneReceiverTest, EndsThoughNobodyEverSentAnything) {
  SampleMeter meter;
  { const HydrophoneReceiver receiver(kUrl, meter); }
  EXPECT_EQ(meter.read().samples_heard, 0U);
}

TEST_F(HydrophoneReceiverTest, TakesBlocksOfSeveralDatagramsAndCountsWhatIsNoBlock) {
  SampleMeter meter;
  const HydrophoneReceiver receiver(kUrl, meter);
  support::HydrophoneDriver driver(kUrl, {.samples_per_block = 4000});  // 128 057 bytes
  host::LcmEndpoint stranger(host::parse_lcm_url(kUrl), {});
  ASSERT_EQ(stranger.publish(wire::kHydrophoneBlockChannel, std::vector<std::uint8_t>(100)), Status::kOk);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(driver.send());
  EXPECT_TRUE(comes_true([&] { return meter.read().samples_heard == 12'000; }));
  EXPECT_EQ(receiver.counters().malformed, 1U);
}

}  // namespace
}  // namespace earshot::board
