#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "sim/annotation/score.hpp"
#include "sim/apps/listen/arguments.hpp"
#include "sim/listening/listening.hpp"

namespace earshot::listen {

inline constexpr host::OutputKind kCsvOutput{"a CSV table of detections", {"begin_s,duration_s,begin_utc,", {}}};
inline constexpr host::OutputKind kJsonOutput{"a JSON file of earshot listen", {"{\n  \"earshot_listen\"", {}}};

/// All that is told of one recording.
struct Result {
  const listening::Plan& plan;
  const listening::Heard& heard;
  std::optional<annotation::Score> score;
  std::vector<annotation::OperatingPoint> curve;  ///< empty without --roc
};

/// One line a detection; what each column is: the folder's README.
[[nodiscard]] std::string csv_of(const Result& result);

/// As a Raven selection table over the same files.
[[nodiscard]] std::string raven_of(const Result& result);

[[nodiscard]] std::string json_of(const Result& result, const Arguments& arguments);

/// What standard output says.
[[nodiscard]] std::string summary_of(const Result& result, const Arguments& arguments);

/// Third-octave levels as NetCDF.
void write_levels(const Result& result, const Arguments& arguments);

/// The pictures that are asked for.
void draw_spectrogram(const Result& result, const Arguments& arguments);
void draw_curve(const Result& result, const Arguments& arguments);

}  // namespace earshot::listen
