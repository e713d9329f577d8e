#pragma once

#include <functional>
#include <optional>
#include <string>

#include "firmware/core/units.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::listening {

/// From samples of a recording to levels.
struct Chain {
  std::optional<Decibels> full_scale_level;  ///< of a sample of 1.0, dB re 1 uPa peak; nothing: not known
  std::string from;                          ///< whence it is known: "calibration.toml", "the icListen's header"
  Hertz high_pass_corner{0.0};
  /// Samples are divided by it before they are heard: 1, or, where a floating-point file goes beyond -1 to 1, the power of two above its
  /// loudest sample, so that nothing of it looks clipped. Levels are of the file's own samples all the same.
  double divisor = 1.0;

  [[nodiscard]] bool is_calibrated() const { return full_scale_level.has_value(); }
  /// What is added to levels of divided samples, dB re 1, for levels as they are told.
  [[nodiscard]] Decibels correction() const;
  /// "dB re 1 uPa" or "dB re full scale"
  [[nodiscard]] const char* unit() const { return is_calibrated() ? "dB re 1 uPa" : "dB re full scale"; }
};

/// Reads a calibration file.
///
///   full scale level = 20 lg(full_scale_v) - sensitivity - gain   (detector::full_scale_level)
///
/// Throws host::BadInput with all that is wrong.
[[nodiscard]] Chain read_calibration(const host::TomlFile& file);

/// What the recorders say, where all of them say the same.
/// @param remark  set where they differ, and none is taken
[[nodiscard]] Chain chain_of_recorders(const recording::Sequence& sequence, std::string& remark);

/// See Chain::divisor. @param largest_magnitude  of the samples
[[nodiscard]] double divisor_for(double largest_magnitude);

/// The largest magnitude of a sample in its floating-point files, which are read through; 0 where there are none.
/// @param tick  called now and then; what it throws ends the reading
[[nodiscard]] double largest_magnitude(const recording::Sequence& sequence, const std::function<void()>& tick);

}  // namespace earshot::listening
