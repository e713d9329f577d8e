// Row detector.times_real_time: how much faster than it comes the detector hears one channel of 48 kHz, in blocks of a tenth of a second.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "tests/bench/short_form.hpp"

int main() {
  using namespace earshot;
  constexpr std::size_t kBlock = 4800;
  constexpr std::size_t kSeconds = 60;
  Pcg32 random(5);
  std::vector<float> samples(kSeconds * 10 * kBlock);
  for (float& x : samples) x = 0.02F * random.uniform_float() - 0.01F;
  const auto detector = std::make_unique<detector::SoundDetector>();
  if (detector->configure(detector::fin_whale()) != Status::kOk) return EXIT_FAILURE;
  messages::HydrophoneBlock block;
  block.sample_rate = Hertz{48'000};
  block.channels = 1;
  block.samples_per_channel = kBlock;
  const std::size_t step = bench::is_wrong_on_purpose() ? 0 : kBlock;  // wrong: the same block for ever
  const std::size_t rounds = bench::full_or_short<std::size_t>(20, 1);
  double best_s = 1e9;
  std::size_t estimates = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < samples.size(); i += kBlock, block.first_sample += step) {
      detector->hear(block, std::span(samples).subspan(i, kBlock));
      while (detector->next()) ++estimates;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    best_s = std::min(best_s, spent.count());
  }
  if (estimates != rounds * kSeconds * 4) {
    std::fprintf(stderr, "%zu estimates of %zu: not every quarter of a second was heard\n", estimates, rounds * kSeconds * 4);
    return EXIT_FAILURE;
  }
  std::printf("{\"value\": %.0f}\n", static_cast<double>(kSeconds) / best_s);
  return EXIT_SUCCESS;
}
