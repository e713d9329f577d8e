#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "policy/explain/recorded_decision.hpp"

namespace earshot::report {

// What a flight left in its folder, as plain numbers in the units of the files.

struct TrackRow {
  double time_s = 0.0;
  double north_m = 0.0;
  double east_m = 0.0;
  double snr_db = 0.0;
  double range_m = 0.0;
};

struct SnrRow {
  double range_m = 0.0;
  double snr_db = 0.0;
};

/// The decisions of one search, as the vehicle journalled them.
struct JournalledSearch {
  std::vector<explain::RecordedDecision> decisions;
  bool is_whole = true;    ///< false: it ends in the middle of a record or in damage
  bool is_journal = true;  ///< false: no record at all where the first should begin
};

struct Flight {
  nlohmann::json summary;
  std::vector<TrackRow> track;
  JournalledSearch journal;
  std::vector<SnrRow> snr;
};

inline constexpr const char* kJournalName = "journal.lcmlog";  ///< in a flight's folder

/// @throws config_file::BadInput naming the file when it cannot be read.
[[nodiscard]] JournalledSearch read_journal(const std::filesystem::path& path);

/// Where a flight keeps the policy that flew it: beside its journal and named after it. Nothing when there is none.
[[nodiscard]] std::optional<std::filesystem::path> policy_beside(const std::filesystem::path& journal);

/// Reads summary.json, track.csv, snr.csv and the decisions in journal.lcmlog.
/// @throws config_file::BadInput naming the file that is missing or cannot be read.
[[nodiscard]] Flight read_flight(const std::filesystem::path& folder);

/// A place in a summary: {"north_m": ..., "east_m": ...}.
[[nodiscard]] NorthEast place_in(const nlohmann::json& place);

}  // namespace earshot::report
