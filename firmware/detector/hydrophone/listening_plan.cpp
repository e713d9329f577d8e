#include "firmware/detector/hydrophone/listening_plan.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/detector/hydrophone/chi_square.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::detector {
namespace {

constexpr double kFirstRate = 32.0;  ///< times the highest frequency, at least: what the first decimator leaves where it can choose
constexpr double kLowRate = 4.0;     ///< likewise the second
constexpr double kPass = 1.2;        ///< times the highest frequency: flat up to there
constexpr double kZOfOneInAThousand = 3.0902323061678132;

std::size_t whole_part(double x) {
  return x < 1.0 ? 1 : static_cast<std::size_t>(x);
}

std::size_t rounded(double x) {
  return whole_part(x + 0.5);
}

Hertz highest_frequency(const SoundSettings& settings) {
  return settings.noise_reference == NoiseReference::kFlanks ? upper_flank(settings.band).high : settings.band.high;
}

/// Two octaves under the band, one octave wide.
Band under(Band band) {
  return {.low = band.low / 4.0, .high = band.low / 2.0};
}

double middle_of(Band band) {
  return log(band.low.value * band.high.value);
}

void plan_flanks(const SoundSettings& settings, ListeningPlan& plan) {
  const Band below = lower_flank(settings.band);
  const Band above = upper_flank(settings.band);
  plan.below = design_band_pass(below, plan.low_rate);
  plan.above = design_band_pass(above, plan.low_rate);
  plan.has_below = true;
  plan.has_above = true;
  plan.flank_weight = (middle_of(above) - middle_of(settings.band)) / (middle_of(above) - middle_of(below));
}

}  // namespace

Band lower_flank(Band band) {
  const Hertz high = band.low - 0.25 * band.width();
  return {.low = high - band.width(), .high = high};
}

Band upper_flank(Band band) {
  const Hertz low = band.high + 0.25 * band.width();
  return {.low = low, .high = low + band.width()};
}

Status make_plan(const SoundSettings& settings, Hertz sample_rate, ListeningPlan& plan) {
  const Hertz top = highest_frequency(settings);
  const double rate = sample_rate.value;
  if (!(rate >= kLeastRateOverBand * top.value) || !(sample_rate <= messages::kHighestSampleRate)) return Status::kUnsupported;
  const std::size_t first = whole_part(rate / (kFirstRate * top.value));
  const Hertz first_rate = sample_rate / static_cast<double>(first);
  const std::size_t second = whole_part(first_rate.value / (kLowRate * top.value));
  if (design_fir(sample_rate, first, kPass * top, plan.first) > config::kFirTaps) return Status::kUnsupported;
  if (design_fir(first_rate, second, kPass * top, plan.second) > config::kSecondFirTaps) return Status::kUnsupported;
  plan.sample_rate = sample_rate;
  plan.low_rate = first_rate / static_cast<double>(second);
  plan.has_below = false;
  plan.has_above = false;
  plan.band = design_band_pass(settings.band, plan.low_rate);
  if (settings.noise_reference == NoiseReference::kFlanks) {
    plan_flanks(settings, plan);
  } else if (under(settings.band).low >= Hertz{1.0}) {
    plan.below = design_band_pass(under(settings.band), plan.low_rate);
    plan.has_below = true;
  }
  const double integration_s = settings.integration_time.to_seconds();
  plan.quarter = rounded(integration_s * plan.low_rate.value / static_cast<double>(kQuarters));
  const BandPassResponse response = measure(plan.band, plan.low_rate, kQuarters * plan.quarter);
  plan.band_width_hz = response.noise_width_hz;
  plan.degrees_of_freedom = response.degrees_of_freedom;
  if (plan.has_below) plan.below_width_hz = measure(plan.below, plan.low_rate, 1).noise_width_hz;
  if (plan.has_above) plan.above_width_hz = measure(plan.above, plan.low_rate, 1).noise_width_hz;
  const double fir_delay_s = plan.first.delay / rate + plan.second.delay / first_rate.value;
  plan.delay_s = fir_delay_s + response.delay / plan.low_rate.value;
  const double settling = 2.0 * fir_delay_s * plan.low_rate.value + response.settling;
  plan.settling_quarters = whole_part(settling / static_cast<double>(plan.quarter)) + 1;
  plan.least_ratio = chi_square_over_mean(plan.degrees_of_freedom, kZOfOneInAThousand);
  const double levels = static_cast<double>(settings.floor_window.us) / static_cast<double>(settings.integration_time.us);
  plan.floor_memory = std::min(rounded(levels), config::kFloorLevels);
  return Status::kOk;
}

}  // namespace earshot::detector
