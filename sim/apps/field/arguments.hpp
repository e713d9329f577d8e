#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/host/program/command_line.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/radial_case.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/model_files/receiver_grid.hpp"
#include "sim/sonar/radial_request.hpp"

namespace earshot::field {

/// What the command line of `earshot field` says.
struct FieldArguments {
  std::string environment;
  std::string library;
  std::string output;
  std::string plot;
  std::string history;  ///< the command itself
  std::optional<double> max_range_km;
  std::optional<double> source_depth_m;
  std::vector<double> depth_m;
  std::optional<double> depth_spacing_m;
  double bearing_deg = 0.0;
  std::size_t radials = 0;  ///< 0: one radial
  bool map = false;
  std::optional<double> map_side_km;
  std::size_t map_intervals = 200;
  std::vector<double> band_hz;  ///< low and high, or nothing
  std::size_t frequencies = 16;
  std::optional<double> range_step_m;
  std::optional<double> output_step_m;
  std::optional<double> depth_step_m;
  std::size_t terms = 0;
  std::optional<double> absorber_wavelengths;
  std::string starter = "self";
  double accuracy_db = 0.02;
  bool check = false;
  bool force = false;  ///< replace files that are of another kind
  double detection_threshold_db = 10.0;
  double fluctuation_db = 0.0;
  std::string shd_layout = "double";
  std::optional<std::size_t> threads;  ///< default: all processors
};

void describe(program::CommandLine& line, FieldArguments& arguments);

/// Throws std::invalid_argument for options that contradict each other, or would be ignored.
void require_consistent(const program::CommandLine& line, const FieldArguments& arguments);

/// Refuses files that cannot be written before the work, not after it, and such as were read. Throws host::BadInput.
/// @param environment  as it was read from its file
void require_writable(const FieldArguments& arguments, const ocean::Environment& environment);

/// @param asked  what the file says, where options say nothing
/// @param default_step_wavelengths  between ranges written where neither names any
[[nodiscard]] sonar::RadialRequest request_of(const FieldArguments& arguments, const ocean::RadialCase& asked,
                                              double default_step_wavelengths);

/// Of the receivers that the file names, those that options leave to it.
[[nodiscard]] sonar::model_files::ReceiverGrid grid_of(const FieldArguments& arguments, const ocean::RadialCase& asked);

enum class OutputFormat : std::uint8_t { kNetcdf, kShade, kGrid };

/// By the output's name: NAME.shd is a shade file, NAME.grid a tl.grid file, all else NetCDF; in capitals, too.
[[nodiscard]] OutputFormat format_of(const FieldArguments& arguments);

/// The option that says what is wrong with a request.
[[nodiscard]] std::string option_of(sonar::BadRequest::What what);

[[nodiscard]] sonar::Detector detector_of(const FieldArguments& arguments, const ocean::Environment& environment);

}  // namespace earshot::field
