// How often the detector's estimates reach a threshold, with noise alone and with a tone in it: what operating_characteristic.py holds
// against theory. Prints CSV: shares of independent estimates (no sound is in two) whose P / N reaches a threshold, with the noise's power
// known and as the detector's own noise floor has it. usage: operating_characteristic DECISIONS

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "tests/support/gaussian_noise.hpp"

namespace {

using namespace earshot;

constexpr double kRate = 240.0;  // low rate 120 Hz: an integration time of exactly 1 s
constexpr double kDeviation = 0.01;
constexpr double kFrequency = 20.3;
constexpr std::array kSnrs_db{-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0};
constexpr double kStep_db = 0.01;
constexpr std::size_t kSteps = 900;  // thresholds from 0 to 9 dB

/// How many estimates reached each threshold.
class Exceedances {
 public:
  void add(double ratio_db) {
    const auto reached = static_cast<std::int64_t>(std::floor(ratio_db / kStep_db));
    if (reached >= 0) ++counts_[std::min<std::size_t>(static_cast<std::size_t>(reached), kSteps - 1)];
    ++decisions_;
  }
  [[nodiscard]] std::vector<double> shares() const {
    std::vector<double> shares(kSteps);
    double sum = 0.0;
    for (std::size_t i = kSteps; i-- > 0;) {
      sum += static_cast<double>(counts_[i]);
      shares[i] = sum / static_cast<double>(decisions_);
    }
    return shares;
  }
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }

 private:
  std::array<std::uint64_t, kSteps> counts_{};
  std::uint64_t decisions_ = 0;
};

struct Curves {
  Exceedances known;
  Exceedances estimated;
};

double noise_level_db() {
  return 180.0 + 20.0 * std::log10(kDeviation) + 10.0 * std::log10(15.0 / (kRate / 2.0));
}

/// Two channels of the same noise, the second with a tone: the first's floor is what the second is held against, so that tones that follow
/// one upon the other do not pass for noise.
void listen(double snr_db, std::uint64_t decisions, Curves& noise, Curves& tone) {
  const auto detector = std::make_unique<detector::SoundDetector>();
  if (detector->configure(detector::fin_whale()) != Status::kOk) std::abort();
  support::GaussianNoise draw(static_cast<std::uint64_t>(1000.0 + snr_db));
  const double amplitude = std::sqrt(2.0 * std::pow(10.0, (noise_level_db() - 180.0 + snr_db) / 10.0));
  std::vector<float> samples(2 * 240'000);
  messages::HydrophoneBlock block;
  block.sample_rate = Hertz{kRate};
  block.samples_per_channel = 240'000;
  block.channels = 2;
  for (std::uint64_t made = 0; made < decisions;) {
    for (std::size_t i = 0; i < 240'000; ++i) {
      const double phase = 2.0 * M_PI * kFrequency * static_cast<double>(block.first_sample + static_cast<std::int64_t>(i)) / kRate;
      samples[2 * i] = static_cast<float>(kDeviation) * draw();
      samples[2 * i + 1] = samples[2 * i] + static_cast<float>(amplitude * std::sin(phase));
    }
    detector->hear(block, samples);
    block.first_sample += 240'000;
    while (const std::optional<detector::Estimate> estimate = detector->next()) {
      if (!estimate->is_independent || block.first_sample <= 240'000) continue;  // the floor's memory is full from there on
      const auto& channels = estimate->channels;
      noise.known.add(channels[0].level.value - noise_level_db());
      noise.estimated.add(channels[0].level.value - channels[0].floor.value);
      tone.known.add(channels[1].level.value - noise_level_db());
      tone.estimated.add(channels[1].level.value - channels[0].floor.value);
      ++made;
    }
  }
}

void print(const char* snr, const Curves& curves) {
  const std::vector<double> known = curves.known.shares();
  const std::vector<double> estimated = curves.estimated.shares();
  for (std::size_t i = 0; i < kSteps; ++i)
    std::printf("%s,%.2f,%.9g,%.9g,%llu\n", snr, kStep_db * static_cast<double>(i), known[i], estimated[i],
                static_cast<unsigned long long>(curves.known.decisions()));
}

}  // namespace

int main(int argc, char** argv) {
  const auto decisions = argc == 2 ? std::strtoull(argv[1], nullptr, 10) : 0;
  if (decisions == 0) {
    std::fputs("usage: operating_characteristic DECISIONS\n", stderr);
    return 2;
  }
  std::puts("snr_db,threshold_db,known,estimated,decisions");
  const auto noise = std::make_unique<Curves>();
  for (const double snr_db : kSnrs_db) {
    const auto tone = std::make_unique<Curves>();
    listen(snr_db, decisions / kSnrs_db.size(), *noise, *tone);
    std::array<char, 16> name{};
    std::snprintf(name.data(), name.size(), "%g", snr_db);
    print(name.data(), *tone);
  }
  print("none", *noise);
  return 0;
}
