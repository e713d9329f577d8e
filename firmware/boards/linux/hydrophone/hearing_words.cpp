#include "firmware/boards/linux/hydrophone/hearing_words.hpp"

#include <cstddef>

#include "firmware/host/text/numbers.hpp"

namespace earshot::board {
namespace {

using detector::Hearing;

/// What a person can do about it; empty where that is nothing.
const char* remedy_of(Hearing hearing) {
  switch (hearing) {
    case Hearing::kHears:
    case Hearing::kFillingUp:
      break;
    case Hearing::kFloorUnsettled:
      return "let it listen for a quarter of floor_window_s before START";
    case Hearing::kFlowNoise:
      return "go slower, or shield the hydrophone";
    case Hearing::kSelfNoise:
      return "go no faster than self_noise_speed_mps";
    case Hearing::kClipped:
      return "less gain";
    case Hearing::kGainChanged:
      return "set the gain before the search, not in it";
    case Hearing::kDropout:
      return "see where samples were lost";
    case Hearing::kOpen:
      return "check hydrophone and cable, or give more gain";
    case Hearing::kStuck:
      return "check for a short circuit, or an ADC that stands still";
    case Hearing::kSaturated:
      return "much less gain, or check the amplifier";
    case Hearing::kNotANumber:
      return "mend the driver that sends them";
    case Hearing::kImpossible:
      return "mend [hydrophone] in the mission, or the sample rate and gain of the blocks";
  }
  return "";
}

std::string seconds(Duration duration) {
  return host::decimals(duration.to_seconds(), duration < Duration::seconds(10) ? 1 : 0) + " s";
}

Duration sum_of(const HydrophoneProcessor::Account& account) {
  Duration sum;
  for (const Duration sound : account.sound) sum = sum + sound;
  return sum;
}

}  // namespace

std::string to_string(const HydrophoneProcessor::Account& account) {
  const auto of = [&account](Hearing hearing) { return account.sound.at(static_cast<std::size_t>(hearing)); };
  std::string text = "it heard " + seconds(of(Hearing::kHears)) + " of " + seconds(sum_of(account)) +
                     " of sound: " + std::to_string(account.measurements) + " SNR measurements, " + std::to_string(account.too_faint) +
                     " of them too faint to measure, and " + std::to_string(account.detections) + " detections";
  if (account.left_out > 0) text += ", of which " + std::to_string(account.left_out) + " came faster than they were taken";
  const char* before = "; not heard: ";
  for (std::size_t i = 1; i < detector::kHearings; ++i) {
    const auto hearing = static_cast<Hearing>(i);
    if (of(hearing) == Duration{}) continue;
    const std::string remedy = remedy_of(hearing);
    text += before + seconds(of(hearing)) + ", " + detector::to_string(hearing) + (remedy.empty() ? "" : " (" + remedy + ")");
    before = "; ";
  }
  return text;
}

std::string to_string(const detector::SoundSettings& settings) {
  return "hears " + host::significant(settings.band.low.value, 6) + " to " + host::significant(settings.band.high.value, 6) +
         " Hz; a sample of full scale is " + host::decimals(detector::full_scale_level(settings.calibration, Decibels{}).value, 1) +
         " dB re 1 uPa, less what gain its blocks name";
}

}  // namespace earshot::board
