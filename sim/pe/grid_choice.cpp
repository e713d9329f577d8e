#include "sim/pe/grid_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "sim/pe/depth_grid.hpp"

namespace earshot::pe {

namespace {

constexpr double kDepthError = 0.028;  // dB at 15 points to a wavelength
constexpr double kDepthPoints = 15.0;
constexpr double kDepthWavelengths = 40.0;  // of water, in which steep waves go wrong by that much; in deeper water by more
constexpr double kDepthGrowth = 0.75;       // the power of it that was measured, 20 to 400 Hz in 3000 m
constexpr double kPhaseError = 0.85;        // dB per radian of the steepest trapped wave
constexpr double kSteepest = 60.0 / 180.0 * std::numbers::pi;
constexpr double kSlopeError = 0.07;  // dB at a step of half a wavelength, a slope of 1 and a range of one wavelength
constexpr double kSlopeStep = 0.5;
constexpr double kCornerError = 0.2;  // dB of the integral of slope^2 / depth
constexpr double kStepError = 4e-7;   // of the amplitude in one step of phase kStepPhase
constexpr double kStepPhase = 16.0;
constexpr double kDecibels = 8.7;  // dB in a relative error of one

constexpr double kThinError = 3.2;   // dB at one step to the water's depth: 20 Hz in 10 and 20 m
constexpr double kThinShare = 0.1;   // of the range: so much may be shallower than the depth that counts, as on the way to a shore
constexpr double kCutOff = 0.5;      // wavelengths of water; in less, sound dies away within a few wavelengths of range
constexpr double kCutOffStep = 1.0;  // wavelengths: what is read off within the first step is not as weak as that
constexpr double kFinestStep = 1.0 / 600.0;

constexpr double kDepthShare = 0.5;  // of the error that is allowed
constexpr double kSlopeShare = 0.3;
constexpr double kStepShare = 0.2;
constexpr double kThinErrorShare = 0.3;

constexpr double kLongestStepPhase = 40.0;  // beyond it 16 poles no longer serve
// What fewer poles can do. Over hundreds of steps their errors partly cancel: a fifth of the sum was measured on slopes.
struct Poles {
  std::size_t terms;
  double error;          // of the amplitude in one step
  double longest_phase;  // to which that holds
};
constexpr Poles kFewPoles[] = {{8, 3e-5, 8.0}, {12, 7e-7, 8.0}};
constexpr double kCancellation = 0.2;
constexpr std::size_t kTerms = 16;

struct Scales {
  double wavelength_m;
  double wavenumber_per_m;
  double trapped_angle;  // of the steepest wave that the sea floor reflects whole
  double slope;          // root mean square
  double corners;        // integral of slope^2 / depth
  double max_range_m;
  double deepest_m;
  double thin_m;  // water depth at the source, or that of the shallowest tenth of the range
};

struct Slopes {
  double mean_square;
  double corners;
};

/// @param shallowest_m  water that is no deeper counts as this deep
Slopes slopes_of(const ocean::Section& section, double max_range_m, double shallowest_m) {
  Slopes sum{0.0, 0.0};
  for (std::size_t i = 1; i < section.sea_floor.size(); ++i) {
    const ocean::SeaFloorStation& a = section.sea_floor[i - 1];
    const ocean::SeaFloorStation& b = section.sea_floor[i];
    const double used = std::min(b.range.value, max_range_m) - std::min(a.range.value, max_range_m);
    const double slope = (b.depth.value - a.depth.value) / (b.range.value - a.range.value);
    sum.mean_square += slope * slope * used / max_range_m;
    sum.corners += slope * slope * used / std::max(shallowest_m, 0.5 * (a.depth.value + b.depth.value));
  }
  return sum;
}

double thin_water_m(const ocean::Section& section, double max_range_m) {
  constexpr int kSamples = 100;
  std::vector<double> depth_m;
  for (int i = 0; i < kSamples; ++i) depth_m.push_back(ocean::sea_floor_depth(section, Meters{max_range_m * (i + 0.5) / kSamples}).value);
  std::ranges::sort(depth_m);
  return std::min(ocean::sea_floor_depth(section, Meters{}).value, depth_m[static_cast<std::size_t>(kThinShare * kSamples)]);
}

Scales scales_of(const ocean::Section& section, Hertz frequency, Meters max_range) {
  const SoundSpeedBounds bounds = sound_speed_bounds(section);
  const double wavelength = bounds.lowest_mps / frequency.value;
  const double trapped_angle = std::min(kSteepest, std::acos(bounds.lowest_mps / bounds.highest_mps));
  const Slopes slopes = slopes_of(section, max_range.value, wavelength);
  return {.wavelength_m = wavelength,
          .wavenumber_per_m = 2.0 * std::numbers::pi / wavelength,
          .trapped_angle = trapped_angle,
          .slope = std::sqrt(slopes.mean_square),
          .corners = slopes.corners,
          .max_range_m = max_range.value,
          .deepest_m = std::ranges::max(section.sea_floor, {}, &ocean::SeaFloorStation::depth).depth.value,
          .thin_m = std::max(1e-3 * wavelength, thin_water_m(section, max_range.value))};
}

/// The first term is what steep waves do near the source, on their way down and up again, the second the phase error of the steepest wave
/// that the sea floor keeps in.
double depth_error_db(const Scales& s, double step_m) {
  const double vertical = s.wavenumber_per_m * std::sin(s.trapped_angle);
  const double horizontal = s.wavenumber_per_m * std::cos(s.trapped_angle);
  const double phase_error = s.max_range_m * vertical * vertical / horizontal * std::pow(vertical * step_m, 4) / 480.0;
  const double way = std::pow(std::max(1.0, s.deepest_m / s.wavelength_m / kDepthWavelengths), kDepthGrowth);
  return kDepthError * way * std::pow(kDepthPoints * step_m / s.wavelength_m, 4) + kPhaseError * phase_error;
}

/// No wave is kept in the water.
bool is_cut_off(const Scales& s) {
  return s.thin_m < kCutOff * s.wavelength_m;
}

/// Of the one element that the sea floor divides, where there are few others.
double thin_error_db(const Scales& s, double step_m) {
  return kThinError * std::pow(step_m / s.thin_m, 4);
}

double slope_error_db(const Scales& s, double step_m) {
  return kSlopeError * std::sqrt(s.max_range_m / s.wavelength_m) * std::pow(s.slope, 1.5) *
         std::pow(step_m / (kSlopeStep * s.wavelength_m), 2);
}

double step_error_db(const Scales& s, double step_m) {
  const double phase = s.wavenumber_per_m * step_m;
  return kDecibels * s.max_range_m / step_m * kStepError * std::pow(phase / kStepPhase, 4);
}

double error_db(const Scales& s, double depth_step_m, double range_step_m) {
  return depth_error_db(s, depth_step_m) + thin_error_db(s, depth_step_m) + slope_error_db(s, range_step_m) + kCornerError * s.corners +
         step_error_db(s, range_step_m);
}

std::size_t choose_terms(const Scales& s, double step_m, double allowed_db) {
  if (is_cut_off(s)) return kTerms;  // the errors of steep and evanescent waves, which fewer poles neglect, stand alone
  for (const Poles& poles : kFewPoles) {
    const double error = kCancellation * kDecibels * s.max_range_m / step_m * poles.error;
    if (s.wavenumber_per_m * step_m <= poles.longest_phase && error <= allowed_db) return poles.terms;
  }
  return kTerms;
}

}  // namespace

GridChoice choose_grid(const ocean::Section& section, Hertz frequency, Meters max_range, Decibels accuracy) {
  const Scales s = scales_of(section, frequency, max_range);
  const double unit = s.wavelength_m / kDepthPoints;
  const double depth_step = unit * std::pow(kDepthShare * accuracy.value / depth_error_db(s, unit), 0.25);  // fourth order
  const double by_thin = s.thin_m * std::pow(kThinErrorShare * accuracy.value / kThinError, 0.25);
  const double by_phase =
      kStepPhase / s.wavenumber_per_m * std::cbrt(kStepShare * accuracy.value / step_error_db(s, kStepPhase / s.wavenumber_per_m));
  const double unit_step = kSlopeStep * s.wavelength_m;
  const double by_slope =
      s.slope > 0.0 ? unit_step * std::sqrt(kSlopeShare * accuracy.value / slope_error_db(s, unit_step)) : by_phase;  // second order
  const double longest = is_cut_off(s) ? kCutOffStep * s.wavelength_m : kLongestStepPhase / s.wavenumber_per_m;
  const double in_deep_water = std::clamp(depth_step, s.wavelength_m / 60.0, s.wavelength_m / 8.0);
  GridChoice choice{.depth_step = Meters{std::max(std::min(in_deep_water, by_thin), kFinestStep * s.wavelength_m)},
                    .range_step = Meters{std::clamp(std::min(by_phase, by_slope), s.wavelength_m / 20.0, longest)},
                    .terms = kTerms,
                    .predicted_error_db = 0.0};
  choice.terms = choose_terms(s, choice.range_step.value, kStepShare * accuracy.value);
  choice.predicted_error_db = error_db(s, choice.depth_step.value, choice.range_step.value);
  return choice;
}

std::optional<std::string> doubt_of(double predicted_error_db, Decibels accuracy) {
  constexpr double kTimes = 10.0;
  constexpr Decibels kMore{1.0};
  if (!(predicted_error_db > std::max(kTimes * accuracy, accuracy + kMore).value)) return std::nullopt;
  std::ostringstream text;
  text.precision(3);
  text << "the error of transmission loss is predicted to be " << predicted_error_db << " dB in the mean where " << accuracy.value
       << " dB was asked for: the sea floor is too rough for the solver's steps";
  return text.str();
}

}  // namespace earshot::pe
