#include "policy/report/flight_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <span>
#include <string>
#include <system_error>

#include "earshot/decision_t.hpp"
#include "firmware/boards/linux/journal_reader.hpp"
#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/config_file/table_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::report {
namespace {

using config_file::BadInput;

std::ifstream open_file(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw BadInput(path.string() + ": no such file, or it cannot be read");
  return stream;
}

nlohmann::json read_summary(const std::filesystem::path& path) {
  std::ifstream stream = open_file(path);
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(path.string() + ": not JSON: " + e.what());
  }
}

[[noreturn]] void refuse_row(const std::filesystem::path& path, std::size_t row, const std::string& fault) {
  throw BadInput(path.string() + ":" + std::to_string(row + 1) + ": " + fault);
}

/// The rows below a table's header. @param read  of one line's text into a row: whether it is one
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& path, bool (*read)(const char* line, Row& row)) {
  std::ifstream stream = open_file(path);
  std::vector<Row> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    if (!read(line.c_str(), rows.emplace_back())) refuse_row(path, rows.size(), "not a row of this table");
  }
  return rows;
}

std::vector<TrackRow> read_track(const std::filesystem::path& path) {
  return read_rows<TrackRow>(path, [](const char* line, TrackRow& row) {
    return std::sscanf(line, "%lf,%lf,%lf,%*f,%*f,%*f,%lf,%lf", &row.time_s, &row.north_m, &row.east_m, &row.snr_db, &row.range_m) == 5;
  });
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
  return rows;
}

/// Sizes are whatever the bytes say, the arrays are not.
template <std::size_t N>
std::vector<float> first_of(const float (&values)[N], std::int8_t count) {
  return {values, values + std::clamp<std::size_t>(static_cast<std::uint8_t>(count), 0, N)};
}

explain::RecordedDecision decision_of(const decision_t& m) {
  return {.step = static_cast<std::uint32_t>(m.step),
          .time_s = static_cast<double>(m.utime) * 1e-6,
          .position = {Meters{m.north_m}, Meters{m.east_m}},
          .heard = {.snr = Decibels{m.snr_db}, .measured = m.too_faint == 0},
          .detected = m.detected != 0,
          .action = static_cast<std::uint8_t>(m.action),
          .overridden = m.overridden != 0,
          .waypoint = {Meters{m.waypoint_north_m}, Meters{m.waypoint_east_m}},
          .observation = first_of(m.observation, m.observation_size),
          .logits = first_of(m.logits, m.action_count)};
}

}  // namespace

JournalledSearch read_journal(const std::filesystem::path& path) try {
  JournalledSearch search;
  board::JournalReader journal(path);
  board::JournalRecord record;
  while (journal.next(record)) {
    decision_t decision{};
    if (record.channel != wire::kDecisionChannel || board::decode(record.data, decision) != Status::kOk) continue;
    search.decisions.push_back(decision_of(decision));
  }
  search.is_whole = journal.end() == board::JournalReader::End::kWhole;
  search.is_journal = search.is_whole || journal.offset() > 0;
  return search;
} catch (const std::system_error& e) {
  throw BadInput(e.what());
}

std::optional<std::filesystem::path> policy_beside(const std::filesystem::path& journal) {
  std::filesystem::path policy = journal;
  policy.replace_extension(".policy");
  return std::filesystem::exists(policy) ? std::optional(policy) : std::nullopt;
}

NorthEast place_in(const nlohmann::json& place) {
  return {Meters{place.at("north_m").get<double>()}, Meters{place.at("east_m").get<double>()}};
}

Flight read_flight(const std::filesystem::path& folder) {
  Flight flight;
  flight.summary = read_summary(folder / "summary.json");
  flight.track = read_track(folder / "track.csv");
  flight.snr = read_snr(folder / "snr.csv");
  if (flight.snr.size() < 2) throw BadInput((folder / "snr.csv").string() + ": at least two rows are needed");
  flight.journal = read_journal(folder / kJournalName);
  return flight;
}

}  // namespace earshot::report
