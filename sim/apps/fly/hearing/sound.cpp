#include "sim/apps/fly/hearing/sound.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/hydrophone/recorded_calls.hpp"

namespace earshot::fly {
namespace {

constexpr Hertz kSampleRate{1000.0};
constexpr int kMostBits = 24;  // a float holds every step

hydrophone::HydrophoneSettings settings_of(const SoundSetup& setup, Decibels noise_level, Duration tick) {
  const detector::Calibration& calibration = setup.listening.calibration;
  return {.sample_rate = kSampleRate,
          .block = tick,
          .band = {.low = setup.listening.band.low, .high = setup.listening.band.high},
          .noise_level = noise_level,
          .self_noise = {.at_two_mps = setup.conditions.self_noise},
          .sound_speed = MetersPerSecond{1500.0},
          .calls = setup.calls,
          .full_scale = full_scale_level(calibration, Decibels{}),
          .gain = {},
          .adc_bits = std::min(calibration.adc_bits, kMostBits),
          .loss = setup.conditions.lost_blocks};
}

}  // namespace

hydrophone::Calls calls_of(const std::filesystem::path& recording, const search::Conditions& conditions, Hertz frequency,
                           const detector::SoundSettings& listening) {
  if (!recording.empty()) return hydrophone::load_calls(recording, listening);
  if (conditions.calls) return hydrophone::Song{.pattern = *conditions.calls, .frequency = frequency};
  return hydrophone::Tone{.frequency = frequency};
}

Sound::Sound(const SoundSetup& setup, const search::Surroundings& surroundings, Duration tick)
    : setup_(setup),
      noise_level_(setup.noise_levels.at(surroundings.ocean())),
      hydrophone_(settings_of(setup, noise_level_, tick), setup.seed),
      sound_detector_(std::make_unique<detector::SoundDetector>()),
      record_(kSampleRate, full_scale_level(setup.listening.calibration, Decibels{})) {
  if (sound_detector_->configure(setup.listening) != Status::kOk)
    throw std::runtime_error("the mission's hydrophone cannot be listened to");
}

void Sound::pass(Time now, const search::Arrivals& arrivals, const policy::Reception& modelled, MetersPerSecond speed) {
  hydrophone::Situation situation{.arrivals = {}, .speed = speed};
  for (const search::Arrival& arrival : arrivals)
    (void)situation.arrivals.push_back({.range = arrival.range, .level = arrival.snr + noise_level_, .sung_s = arrival.sung_s});
  measurements_.clear();
  if (!has_begun_) {
    hydrophone_.begin(situation);
    has_begun_ = true;
    return;
  }
  if (!hydrophone_.hear(situation, now)) {
    ++lost_blocks_;
    return;
  }
  if (setup_.bus.publish(hydrophone_.block(), hydrophone_.samples()) != Status::kOk)
    throw std::runtime_error("sound cannot be put on the LCM bus");
  hear(modelled);
}

void Sound::hear(const policy::Reception& modelled) {
  record_.take(hydrophone_.block(), hydrophone_.samples());
  sound_detector_->hear(hydrophone_.block(), hydrophone_.samples());
  while (const std::optional<detector::Estimate> estimate = sound_detector_->next()) {
    hearing_ = estimate->hearing;
    if (!estimate->is_snr_measurement()) continue;  // as the vehicle hands over its measurements
    measurements_.push_back(estimate->measurement());
    record_.add(*estimate, modelled);
  }
}

}  // namespace earshot::fly
