#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/messages/journal_records.hpp"
#include "policy/explain/recorded_decision.hpp"
#include "policy/report/sea/sea_flight.hpp"
#include "policy/report/sound/heard_sound.hpp"

namespace earshot::report {

// What a flight left in its folder, as plain numbers in the units of the files.

struct SnrRow {
  double range_m = 0.0;
  double snr_db = 0.0;
};

/// The decisions of one search, as the vehicle journalled them.
struct JournalledSearch {
  std::vector<explain::RecordedDecision> decisions;
  host::JournalReader::End end = host::JournalReader::End::kWhole;
  std::vector<host::JournalDamage> damages;  ///< what was passed over, that of the end included
  std::uint64_t records = 0;                 ///< that were read, decisions and others
  std::uint64_t bytes = 0;                   ///< of the file
  std::uint64_t missing = 0;                 ///< records that are not there, by their numbers
  std::uint64_t first_missing = 0;
  std::optional<messages::ClosingRecord> closing;  ///< nothing: the program that wrote it did not end in order

  void take(const journal::Entry& entry);
  /// The journal has come to its end.
  void end_with(const journal::RecordSource& source);

  [[nodiscard]] bool is_whole() const { return damages.empty() && missing == 0 && closing; }
  /// False: no record at all.
  [[nodiscard]] bool is_journal() const { return damages.empty() || records > 0; }
};

/// What a journal lacks that is not whole, in sentences with the bytes and the records; "" for a whole one.
[[nodiscard]] std::string lack_of(const JournalledSearch& journal);

/// What a simulator left of a flight. At sea there is none of it, nor where it was killed: whatever is not there is empty.
struct FlightFiles {
  nlohmann::json summary;  ///< null: none
  std::vector<SnrRow> snr;
  HeardSound sound;                  ///< of a flight that heard
  std::vector<std::string> missing;  ///< names of files that a simulator should have left
};

inline constexpr const char* kJournalName = host::kFirstJournal;  ///< in a simulated flight's folder

/// @throws host::BadInput naming the file when it cannot be read.
[[nodiscard]] JournalledSearch read_journal(const std::filesystem::path& path);

/// Where a flight keeps the policy that flew it, and its ocean tables: beside its journal and named after it. Nothing when there is none.
/// @param extension  ".policy", ".tables"
[[nodiscard]] std::optional<std::filesystem::path> beside_journal(const std::filesystem::path& journal, const std::string& extension);

/// The journal of a flight that is named by its folder: where no summary.json is there, the newest of those that flights at sea left in it.
/// Any other path is itself.
[[nodiscard]] std::filesystem::path journal_of_flight(const std::filesystem::path& folder_or_journal);

/// Of a folder what is there of summary.json and snr.csv, and of hearing.csv and spectrogram.csv when the summary says that it heard.
/// @throws host::BadInput naming the file that cannot be read.
[[nodiscard]] FlightFiles read_flight_files(const std::filesystem::path& folder_or_journal);

/// All that belongs to a flight: the parts of its journal, the policy, the tables, a simulator's files. Some may not
/// be there. @throws host::BadInput naming the journal when it cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> files_of_flight(const std::filesystem::path& folder_or_journal);

/// A place in a summary: {"north_m": ..., "east_m": ...}.
[[nodiscard]] NorthEast place_in(const nlohmann::json& place);

}  // namespace earshot::report
