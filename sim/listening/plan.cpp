#include "sim/listening/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "sim/listening/decimator.hpp"

namespace earshot::listening {
namespace {

using recording::Sequence;

/// No hydrophone's recorder takes more; beyond it a number is damage.
constexpr Hertz kHighestSampleRate{1'000'000.0};

struct Preset {
  const char* name;
  detector::SoundSettings (*settings)();
};

constexpr std::array kPresets{Preset{"fin", detector::fin_whale}, Preset{"blue", detector::blue_whale},
                              Preset{"antarctic", detector::antarctic_blue_whale}, Preset{"tone", detector::continuous_tone}};

/// What the detector is asked for; the band as it was asked for, whatever the recording holds.
detector::SoundSettings settings_of(const Request& request) {
  detector::SoundSettings settings;
  for (const Preset& preset : kPresets)
    if (request.preset == preset.name) settings = preset.settings();
  if (request.band) settings.band = *request.band;
  if (request.threshold) settings.detection_threshold = *request.threshold;
  return settings;
}

std::string name_of(const Sequence& sequence) {
  const std::string first = sequence.parts().front().path.string();
  return sequence.files() == 1 ? first : first + " and " + std::to_string(sequence.files() - 1) + " more";
}

/// Steps of the ADC as the noise of one would be at the rate that is listened to: four times the rate spreads it as a bit more does.
int bits_at_listening_rate(const Sequence& sequence) {
  const int bits = sequence.parts().front().format.bits;
  const double more = std::floor(std::log2(static_cast<double>(decimation_for(sequence.sample_rate()))) / 2.0);
  return std::min(bits + static_cast<int>(more), std::max(bits, 24));
}

std::string band_text(detector::Band band) {
  std::ostringstream text;
  text.precision(4);
  text << band.low.value << " to " << band.high.value << " Hz";
  return text.str();
}

std::string rate_text(const Sequence& sequence) {
  std::ostringstream text;
  text.precision(9);
  text << "it is sampled at " << sequence.sample_rate().value << " Hz";
  return text.str();
}

void require_sample_rate(const Sequence& sequence) {
  if (sequence.sample_rate() <= kHighestSampleRate) return;
  std::ostringstream limit;
  limit.precision(9);
  limit << ", and no more than " << kHighestSampleRate.value << " Hz are taken: resample it";
  throw unheard(sequence, rate_text(sequence) + limit.str());
}

void require_audible(const Sequence& sequence, const detector::SoundSettings& settings, detector::Band asked) {
  const detector::SettingsFault fault = detector::check(settings);
  if (fault == detector::SettingsFault::kNone) return;
  if (settings.band != asked) throw unheard(sequence, rate_text(sequence) + ", too slowly for the band of " + band_text(asked));
  if (fault == detector::SettingsFault::kCalibration)
    throw host::BadInput("--calibration: with it " + name_of(sequence) + " cannot be listened to: " +
                         detector::to_string(detector::check(settings.calibration, Decibels{0.0}, listening_rate(sequence), settings.band,
                                                             settings.expected_noise)));
  // Presets have no fault, and thresholds are within their bounds.
  throw host::BadInput(std::string("--band: ") + detector::to_string(fault));
}

Chain chain_for(const Request& request, const Sequence& sequence, std::vector<std::string>& remarks) {
  if (request.chain) return *request.chain;
  std::string remark;
  Chain chain = chain_of_recorders(sequence, remark);
  if (!remark.empty()) remarks.push_back(remark);
  return chain;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

Hertz listening_rate(const Sequence& sequence) {
  return sequence.sample_rate() / static_cast<double>(decimation_for(sequence.sample_rate()));
}

host::BadInput unheard(const Sequence& sequence, const std::string& why) {
  return host::BadInput(name_of(sequence) + ": cannot be listened to: " + why);
}

Decibels correction_of(const Plan& plan) {
  return plan.chain.correction() - kNominalFullScale;
}

Plan plan_for(Sequence sequence, const Request& request) {
  if (request.channel > sequence.channels())
    throw host::BadInput("--channel = " + std::to_string(request.channel) + ": " + name_of(sequence) + " has " +
                         std::to_string(sequence.channels()));
  require_sample_rate(sequence);
  Plan plan{.sequence = std::move(sequence),
            .channel = request.channel - 1,
            .chain = {},
            .settings = settings_of(request),
            .asked = {},
            .remarks = {}};
  plan.remarks = plan.sequence.remarks();
  plan.chain = chain_for(request, plan.sequence, plan.remarks);
  plan.asked = plan.settings.band;
  plan.settings.band = detector::audible_part(plan.asked, plan.sequence.sample_rate());
  plan.settings.calibration = {.sensitivity = -kNominalFullScale,
                               .fixed_gain = Decibels{0.0},
                               .full_scale_volts = 1.0,
                               .adc_bits = bits_at_listening_rate(plan.sequence),
                               .high_pass_corner = plan.chain.high_pass_corner};
  require_audible(plan.sequence, plan.settings, plan.asked);
  return plan;
}

}  // namespace earshot::listening
