#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace earshot::report {

// What a flight left in its folder, as plain numbers in the units of the files.

struct TrackRow {
  double time_s = 0.0;
  double north_m = 0.0;
  double east_m = 0.0;
  double snr_db = 0.0;
  double range_m = 0.0;
};

struct DecisionRow {
  double time_s = 0.0;
  int step = 0;  ///< 0 for the first action
  double north_m = 0.0;
  double east_m = 0.0;
  double snr_db = 0.0;
  bool detected = false;
  int action = 0;
  bool overridden = false;            ///< by the safety layer
  std::vector<double> probabilities;  ///< of each action: softmax of the policy's logits
};

struct SnrRow {
  double range_m = 0.0;
  double snr_db = 0.0;
};

struct Flight {
  nlohmann::json summary;
  std::vector<TrackRow> track;
  std::vector<DecisionRow> decisions;
  std::vector<SnrRow> snr;
  bool journal_is_whole = true;  ///< false: it ends in the middle of a record or in damage
};

/// Reads summary.json, track.csv, snr.csv and the decisions in journal.lcmlog.
/// @throws config_file::BadInput naming the file that is missing or cannot be read.
[[nodiscard]] Flight read_flight(const std::filesystem::path& folder);

}  // namespace earshot::report
