#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/host/memory/heap_trap.hpp"

namespace earshot::detector {
namespace {

TEST(SoundDetector, UsesNoHeapFromConfigurationToTheEndOfAMinuteOfEightChannels) {
  Pcg32 random(5);
  std::vector<float> samples(8 * 9600);
  for (float& x : samples) x = 0.02F * random.uniform_float() - 0.01F;
  const auto detector = std::make_unique<SoundDetector>();
  messages::HydrophoneBlock block;
  block.sample_rate = Hertz{96'000};
  block.channels = 8;
  block.samples_per_channel = 9600;
  int estimates = 0;
  host::arm_heap_trap();
  const Status status = detector->configure(fin_whale());
  for (int tenth = 0; tenth < 600; ++tenth, block.first_sample += 9600) {
    detector->hear(block, samples);
    while (detector->next()) ++estimates;
  }
  static_cast<void>(detector->finish());
  host::disarm_heap_trap();
  EXPECT_EQ(status, Status::kOk);
  EXPECT_EQ(estimates, 240);
  EXPECT_TRUE(host::heap_uses().empty()) << to_string(host::heap_uses().front());
}

}  // namespace
}  // namespace earshot::detector
