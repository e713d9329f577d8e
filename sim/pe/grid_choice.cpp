#include "sim/pe/grid_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/pe/depth_grid.hpp"

namespace earshot::pe {

namespace {

constexpr double kDepthError = 0.014;  // dB at 15 points to a wavelength
constexpr double kDepthPoints = 15.0;
constexpr double kSlopeError = 0.056;  // dB at two thirds of a wavelength and a slope of 1 in 10
constexpr double kSlopeStep = 2.0 / 3.0;
constexpr double kSlope = 0.1;
constexpr double kStepError = 4e-7;  // of the amplitude in one step of phase kStepPhase
constexpr double kStepPhase = 16.0;
constexpr double kDecibels = 8.7;  // dB in a relative error of one

constexpr double kDepthShare = 0.4;  // of the error that is allowed
constexpr double kSlopeShare = 0.4;
constexpr double kStepShare = 0.2;

constexpr double kLongestStepPhase = 40.0;  // beyond it 16 poles no longer serve
constexpr std::size_t kTerms = 16;

struct Scales {
  double wavelength_m;
  double wavenumber_per_m;
  double slope;  // root mean square
  double max_range_m;
};

double mean_square_slope(const Section& section, double max_range_m) {
  double sum = 0.0;
  for (std::size_t i = 1; i < section.floor.size(); ++i) {
    const FloorPoint& a = section.floor[i - 1];
    const FloorPoint& b = section.floor[i];
    const double used = std::min(b.range_m, max_range_m) - std::min(a.range_m, max_range_m);
    const double slope = (b.depth_m - a.depth_m) / (b.range_m - a.range_m);
    sum += slope * slope * used;
  }
  return sum / max_range_m;
}

Scales scales_of(const Section& section, Hertz frequency, Meters max_range) {
  const double wavelength = sound_speed_bounds(section).lowest_mps / frequency.value;
  return {wavelength, 2.0 * std::numbers::pi / wavelength, std::sqrt(mean_square_slope(section, max_range.value)), max_range.value};
}

double depth_error_db(const Scales& s, double step_m) {
  return kDepthError * std::pow(kDepthPoints * step_m / s.wavelength_m, 4);
}

double slope_error_db(const Scales& s, double step_m) {
  return kSlopeError * std::pow(step_m / (kSlopeStep * s.wavelength_m), 2) * std::pow(s.slope / kSlope, 2);
}

double step_error_db(const Scales& s, double step_m) {
  const double phase = s.wavenumber_per_m * step_m;
  return kDecibels * s.max_range_m / step_m * kStepError * std::pow(phase / kStepPhase, 4);
}

}  // namespace

double predicted_error_db(const Section& section, Hertz frequency, Meters max_range, Meters depth_step, Meters range_step) {
  const Scales s = scales_of(section, frequency, max_range);
  return depth_error_db(s, depth_step.value) + slope_error_db(s, range_step.value) + step_error_db(s, range_step.value);
}

GridChoice choose_grid(const Section& section, Hertz frequency, Meters max_range, Decibels accuracy) {
  const Scales s = scales_of(section, frequency, max_range);
  const double depth_step = s.wavelength_m / kDepthPoints * std::pow(kDepthShare * accuracy.value / kDepthError, 0.25);
  const double by_phase =
      kStepPhase / s.wavenumber_per_m * std::cbrt(kStepShare * accuracy.value / step_error_db(s, kStepPhase / s.wavenumber_per_m));
  const double by_slope =
      s.slope > 0.0 ? kSlopeStep * s.wavelength_m * (kSlope / s.slope) * std::sqrt(kSlopeShare * accuracy.value / kSlopeError) : by_phase;
  const double longest = kLongestStepPhase / s.wavenumber_per_m;
  GridChoice choice{.depth_step = Meters{std::clamp(depth_step, s.wavelength_m / 60.0, s.wavelength_m / 8.0)},
                    .range_step = Meters{std::clamp(std::min(by_phase, by_slope), s.wavelength_m / 20.0, longest)},
                    .terms = kTerms,
                    .predicted_error_db = 0.0};
  choice.predicted_error_db =
      depth_error_db(s, choice.depth_step.value) + slope_error_db(s, choice.range_step.value) + step_error_db(s, choice.range_step.value);
  return choice;
}

}  // namespace earshot::pe
