#include "policy/report/flight_files.hpp"

#include <cmath>
#include <cstdio>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/messages/health.hpp"
#include "policy/description/json_fault.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {
namespace {

using host::BadInput;

constexpr double kMost = 1e15;  // a double tells whole numbers apart up to there

bool is_number(const nlohmann::json& value, double least = -kMost, double most = kMost) {
  return value.is_number() && value.get<double>() >= least && value.get<double>() <= most;
}

bool is_place(const nlohmann::json& value) {
  return value.is_object() && is_number(value.value("north_m", nlohmann::json())) && is_number(value.value("east_m", nlohmann::json()));
}

/// A number of a summary and what it may be.
struct SummaryNumber {
  const char* key;
  double least;
  double most;
  const char* what;
  bool is_optional = false;
};
constexpr SummaryNumber kSummaryNumbers[] = {
    {"reward", -kMost, kMost, "a number"},
    {"distance_m", 0.0, kMost, "a number from 0"},
    {"sim_time_s", 0.0, kMost, "a number from 0"},
    {"wall_time_s", 0.0, kMost, "a number from 0"},
    {"detection_threshold_db", -kMost, kMost, "a number"},
    {"battery_percent", 0.0, 100.0, "a number, 0 to 100", true},
    {"depth_m", 0.0, kMost, "a number from 0", true},
    {"speed_mps", 0.0, kMost, "a number from 0", true},
    {"source_frequency_hz", 0.0, kMost, "a number from 0", true},
};

/// Refuses a summary whose keys are missing or do not hold what they should.
void check_summary(const std::filesystem::path& path, const nlohmann::json& summary) {
  const auto require = [&](const char* key, bool holds, const char* what) {
    if (!holds) throw BadInput(path.string() + ": " + key + ": must be " + what);
  };
  require("the whole", summary.is_object(), "a table");
  const auto value = [&](const char* key) { return summary.value(key, nlohmann::json()); };
  require("found", value("found").is_boolean(), "true or false");
  for (const char* key : {"steps", "detections"})
    require(key, value(key).is_number_unsigned() && value(key).get<std::uint64_t>() <= 1'000'000'000, "a whole number, 0 to 1000000000");
  require("seed", value("seed").is_number_unsigned(), "a whole number from 0");
  for (const SummaryNumber& number : kSummaryNumbers) {
    if (number.is_optional && !summary.contains(number.key)) continue;
    require(number.key, is_number(value(number.key), number.least, number.most), number.what);
  }
  require("flown_utc", !summary.contains("flown_utc") || value("flown_utc").is_string(), "a text");
  const nlohmann::json origin = value("origin");
  const bool is_geographic = origin.is_object() && is_number(origin.value("latitude_deg", nlohmann::json())) &&
                             is_number(origin.value("longitude_deg", nlohmann::json()));
  require("origin", origin.is_null() || is_geographic, "latitude_deg, longitude_deg");
  for (const char* key : {"end_reason", "environment", "mission"}) require(key, value(key).is_string(), "a text");
  for (const char* key : {"source", "start"}) require(key, is_place(value(key)), "a place: north_m, east_m");
  const nlohmann::json area = value("area");
  const bool is_area =
      area.is_object() && is_place(area.value("south_west", nlohmann::json())) && is_place(area.value("north_east", nlohmann::json()));
  require("area", is_area, "two places: south_west, north_east");
  if (const std::string fault = search::fault_in_account(summary); !fault.empty()) throw BadInput(path.string() + ": " + fault);
}

nlohmann::json read_summary(const std::filesystem::path& path) {
  try {
    nlohmann::json summary = nlohmann::json::parse(host::read_text(path, host::kJsonFile));
    check_summary(path, summary);
    return summary;
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(path.string() + ": " + description::to_string(e));
  }
}

[[noreturn]] void refuse_row(const std::filesystem::path& path, std::size_t row, const std::string& fault) {
  throw BadInput(path.string() + ":" + std::to_string(row + 1) + ": " + fault);
}

/// The rows below a table's header. @param read  of one line's text into a row: whether it is one
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& path, bool (*read)(const char* line, Row& row)) {
  std::istringstream stream(host::read_text(path, host::kCsvFile));
  std::vector<Row> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    if (!read(line.c_str(), rows.emplace_back())) refuse_row(path, rows.size(), "not a row of this table");
  }
  return rows;
}

void require_rows(const std::filesystem::path& path, std::size_t rows, std::size_t least) {
  if (rows < least)
    throw BadInput(path.string() + ": has " + host::counted(rows, "row") + " below its header; needs at least " + std::to_string(least));
}

/// What is wrong with a row of a curve over ranges that rise from 0 by one step; nothing when it is right.
const char* fault_in(std::span<const SnrRow> rows, std::size_t i) {
  constexpr double kUnevenness = 0.01;  // of a step: ranges are written rounded
  if (!std::isfinite(rows[i].range_m) || !std::isfinite(static_cast<float>(rows[i].snr_db))) return "range and SNR must be finite numbers";
  if (i == 0) return rows[0].range_m == 0.0 ? nullptr : "the first range_m must be 0";
  const double first_step = rows[1].range_m - rows[0].range_m;
  const double step = rows[i].range_m - rows[i - 1].range_m;
  const bool rises = step > 0.0 && std::isfinite(step) && std::abs(step - first_step) <= kUnevenness * first_step;
  return rises ? nullptr : "range_m must rise by the same step from row to row";
}

std::vector<SnrRow> read_snr(const std::filesystem::path& path) {
  std::vector<SnrRow> rows =
      read_rows<SnrRow>(path, [](const char* line, SnrRow& row) { return std::sscanf(line, "%lf,%lf", &row.range_m, &row.snr_db) == 2; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (const char* const fault = fault_in(rows, i)) refuse_row(path, i + 1, fault);
  }
  require_rows(path, rows.size(), 2);
  return rows;
}

std::string bytes_to_string(const host::JournalDamage& damage) {
  return host::counted(damage.bytes, "byte") + " from byte " + std::to_string(damage.offset) + " on" +
         (damage.part.empty() ? "" : " of " + damage.part);
}

/// What was passed over before the journal's last record; "" for nothing.
std::string damage_within(const JournalledSearch& journal) {
  const bool is_end_damaged = journal.end != host::JournalReader::End::kWhole;
  const auto within = std::span(journal.damages).first(journal.damages.size() - (is_end_damaged ? 1 : 0));
  if (within.empty()) return "";
  std::uint64_t sum = 0;
  for (const host::JournalDamage& damage : within) sum += damage.bytes;
  if (within.size() == 1)
    return "The journal is damaged: " + bytes_to_string(within.front()) + " are no record. What stands behind was read.";
  return "The journal is damaged in " + std::to_string(within.size()) + " places, " + std::to_string(sum) + " bytes in all, the first " +
         bytes_to_string(within.front()) + ". What stands between and behind was read.";
}

std::string missing_records(const JournalledSearch& journal) {
  if (journal.missing == 0) return "";
  std::string text =
      "The journal lacks " + std::to_string(journal.missing) + " records from number " + std::to_string(journal.first_missing) + " on: ";
  text += journal.damages.empty() ? "the disk was full or too slow." : "damaged, or the disk was full or too slow.";
  if (journal.closing && journal.closing->lost.all() > 0) text += " Lost were " + journal::to_string(journal.closing->lost) + ".";
  return text;
}

/// Where and why a journal ends before its end; "" for one that does not.
std::string ending_of(const JournalledSearch& journal) {
  using End = host::JournalReader::End;
  if (journal.end == End::kWhole && journal.closing) return "";
  if (journal.end == End::kWhole)
    return "The journal's end is missing: no closing record stands behind its last record, for the runtime was killed, lost its power, met "
           "an error, or is of a version that wrote none.";
  const std::string last = bytes_to_string(journal.damages.back()) + " of " + std::to_string(journal.bytes);
  const std::string read = " Read before it: " + std::to_string(journal.records) + " records, " + std::to_string(journal.decisions.size()) +
                           " decisions among them.";
  if (journal.end == End::kCut)
    return "The journal ends with " + last + ", which are no whole record: the runtime was stopped while it wrote." + read;
  return "The journal's end is damaged: the last " + last + " are no record." + read;
}

void note(const journal::MissingRecords& missing, JournalledSearch& search) {
  if (search.missing == 0) search.first_missing = missing.first;
  search.missing += missing.count;
}

void note(const journal::Record& record, JournalledSearch& search) {
  if (const auto* const closing = std::get_if<messages::ClosingRecord>(&record.content)) search.closing = *closing;
  const auto* const decision = std::get_if<messages::Decision>(&record.content);
  if (decision == nullptr) return;
  explain::RecordedDecision recorded{*decision};
  const bool was_before = recorded.step > 0 && !search.decisions.empty() && search.decisions.back().was_mismatched;
  recorded.was_mismatched = was_before || recorded.mismatch_bits() >= messages::kMismatchThreshold_bits;
  search.decisions.push_back(recorded);
}

}  // namespace

void JournalledSearch::take(const journal::Entry& entry) {
  if (const auto* const gap = std::get_if<journal::MissingRecords>(&entry)) note(*gap, *this);
  if (const auto* const record = std::get_if<journal::Record>(&entry)) note(*record, *this);
}

void JournalledSearch::end_with(const journal::RecordSource& source) {
  records = source.records();
  end = source.file().end();
  damages = source.file().damages();
  bytes = source.file_size();
}

JournalledSearch read_journal(const std::filesystem::path& path) {
  JournalledSearch search;
  journal::RecordSource source(path);
  while (const std::optional<journal::Entry> entry = source.next()) search.take(*entry);
  search.end_with(source);
  return search;
}

std::string lack_of(const JournalledSearch& journal) {
  std::string lack;
  for (const std::string& sentence : {damage_within(journal), missing_records(journal), ending_of(journal)})
    if (!sentence.empty()) lack += (lack.empty() ? "" : " ") + sentence;
  return lack;
}

std::vector<std::filesystem::path> files_of_flight(const std::filesystem::path& folder_or_journal) {
  const bool is_folder = std::filesystem::is_directory(folder_or_journal);
  const std::filesystem::path journal = journal_of_flight(folder_or_journal);
  std::vector<std::filesystem::path> files{journal};
  if (std::filesystem::exists(journal)) files = host::JournalParts(journal).files();
  for (const char* extension : {".policy", ".tables"}) files.push_back(std::filesystem::path(journal).replace_extension(extension));
  if (!is_folder) return files;
  for (const char* name : {"summary.json", "track.csv", "snr.csv", kHearingName, kSpectrogramName})
    files.push_back(folder_or_journal / name);
  return files;
}

std::optional<std::filesystem::path> beside_journal(const std::filesystem::path& journal, const std::string& extension) {
  std::filesystem::path file = journal;
  file.replace_extension(extension);
  return std::filesystem::exists(file) ? std::optional(file) : std::nullopt;
}

NorthEast place_in(const nlohmann::json& place) {
  return {Meters{place.at("north_m").get<double>()}, Meters{place.at("east_m").get<double>()}};
}

std::filesystem::path journal_of_flight(const std::filesystem::path& folder_or_journal) {
  const bool is_of_simulation = std::filesystem::exists(folder_or_journal / "summary.json");
  return is_of_simulation ? folder_or_journal / kJournalName : host::newest_journal_in(folder_or_journal);
}

FlightFiles read_flight_files(const std::filesystem::path& folder_or_journal) {
  FlightFiles files;
  if (!std::filesystem::is_directory(folder_or_journal)) return files;
  const auto is_there = [&](const char* name) {
    if (std::filesystem::exists(folder_or_journal / name)) return true;
    files.missing.emplace_back(name);
    return false;
  };
  if (is_there("summary.json")) files.summary = read_summary(folder_or_journal / "summary.json");
  if (is_there("snr.csv")) files.snr = read_snr(folder_or_journal / "snr.csv");
  const bool has_heard = files.summary.is_object() && files.summary.contains("hearing");
  if (has_heard && is_there(kHearingName) && is_there(kSpectrogramName)) files.sound = read_heard_sound(folder_or_journal);
  return files;
}

}  // namespace earshot::report
