#include "sim/listening/chain.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/detector/hydrophone/calibration.hpp"

namespace earshot::listening {
namespace {

constexpr double kLoudest = 1e30;

}  // namespace

Decibels Chain::correction() const {
  return Decibels{20.0 * std::log10(divisor)} + full_scale_level.value_or(Decibels{0.0});
}

Chain read_calibration(const host::TomlFile& file) {
  using host::Range;
  host::TableReader table = file.root();
  Chain chain{.full_scale_level = {}, .from = file.path().filename().string()};
  const char* const kLevel = "full_scale_level_db_re_1upa";
  const char* const kSensitivity = "sensitivity_db_re_1v_per_upa";
  if (table.has(kLevel)) {
    chain.full_scale_level = Decibels{table.number(kLevel, Range::between(-100.0, 400.0))};
    for (const char* key : {kSensitivity, "gain_db", "full_scale_v"})
      if (table.has(key)) table.problem(key, std::string("not beside ") + kLevel + ", which holds it");
  } else {
    detector::Calibration calibration;
    calibration.sensitivity = Decibels{table.number(kSensitivity, Range::between(-260.0, -100.0))};
    calibration.fixed_gain = Decibels{table.number_or("gain_db", 0.0, Range::between(-200.0, 200.0))};
    calibration.full_scale_volts = table.number("full_scale_v", Range::between(1e-6, 1e3));
    chain.full_scale_level = detector::full_scale_level(calibration, Decibels{0.0});
  }
  chain.high_pass_corner = Hertz{table.number_or("high_pass_corner_hz", 0.0, Range::between(0.0, 1000.0))};
  file.finish();
  return chain;
}

Chain chain_of_recorders(const recording::Sequence& sequence, std::string& remark) {
  const recording::RecorderNotes& first = sequence.parts().front().notes;
  const bool agree = std::ranges::all_of(sequence.parts(), [&](const recording::Part& part) {
    return part.notes.sensitivity == first.sensitivity && part.notes.full_scale_volts == first.full_scale_volts;
  });
  if (!agree) remark = "the files' headers give different calibrations: none is taken; --calibration gives one";
  if (!agree || !first.sensitivity || !first.full_scale_volts) return {};
  detector::Calibration calibration;
  calibration.sensitivity = *first.sensitivity;
  calibration.full_scale_volts = *first.full_scale_volts;
  return {.full_scale_level = detector::full_scale_level(calibration, Decibels{0.0}), .from = "the " + first.recorder + "'s header"};
}

double divisor_for(double largest_magnitude) {
  return largest_magnitude <= 1.0 ? 1.0 : std::exp2(std::floor(std::log2(std::min(largest_magnitude, kLoudest))) + 1.0);
}

double largest_magnitude(const recording::Sequence& sequence, const std::function<void()>& tick) {
  double largest = 0.0;
  for (const recording::Part& part : sequence.parts())
    if (part.format.is_float) largest = std::max(largest, recording::largest_magnitude(part.path, tick));
  return largest;
}

}  // namespace earshot::listening
