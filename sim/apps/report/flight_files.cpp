#include "sim/apps/report/flight_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
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

[[noreturn]] void refuse_line(const std::filesystem::path& path, std::size_t number) {
  throw BadInput(path.string() + ":" + std::to_string(number) + ": not a row of this table");
}

std::vector<TrackRow> read_track(const std::filesystem::path& path) {
  std::ifstream stream = open_file(path);
  std::vector<TrackRow> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    TrackRow row;
    const int fields =
        std::sscanf(line.c_str(), "%lf,%lf,%lf,%*f,%*f,%*f,%lf,%lf", &row.time_s, &row.north_m, &row.east_m, &row.snr_db, &row.range_m);
    if (fields != 5) refuse_line(path, rows.size() + 2);
    rows.push_back(row);
  }
  return rows;
}

std::vector<SnrRow> read_snr(const std::filesystem::path& path) {
  std::ifstream stream = open_file(path);
  std::vector<SnrRow> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    SnrRow row;
    if (std::sscanf(line.c_str(), "%lf,%lf", &row.range_m, &row.snr_db) != 2) refuse_line(path, rows.size() + 2);
    rows.push_back(row);
  }
  return rows;
}

std::vector<double> softmax(const float* logits, std::size_t count) {
  std::vector<double> p(count);
  if (count == 0) return p;
  const double top = static_cast<double>(*std::max_element(logits, logits + count));
  std::transform(logits, logits + count, p.begin(), [top](float logit) { return std::exp(static_cast<double>(logit) - top); });
  const double sum = std::accumulate(p.begin(), p.end(), 0.0);
  for (double& x : p) x /= sum;
  return p;
}

DecisionRow row_of(const decision_t& m) {
  const std::size_t count = std::clamp<std::size_t>(static_cast<std::uint8_t>(m.action_count), 0, std::size(m.logits));
  return {.time_s = static_cast<double>(m.utime) * 1e-6,
          .step = m.step,
          .north_m = m.north_m,
          .east_m = m.east_m,
          .snr_db = m.snr_db,
          .detected = m.detected != 0,
          .action = m.action,
          .overridden = m.overridden != 0,
          .probabilities = softmax(std::data(m.logits), count)};
}

void read_journal(const std::filesystem::path& path, Flight& flight) try {
  board::JournalReader journal(path);
  board::JournalRecord record;
  while (journal.next(record)) {
    decision_t decision{};
    if (record.channel != wire::kDecisionChannel || board::decode(record.data, decision) != Status::kOk) continue;
    flight.decisions.push_back(row_of(decision));
  }
  flight.journal_is_whole = journal.end() == board::JournalReader::End::kWhole;
} catch (const std::system_error& e) {
  throw BadInput(e.what());
}

}  // namespace

Flight read_flight(const std::filesystem::path& folder) {
  Flight flight;
  flight.summary = read_summary(folder / "summary.json");
  flight.track = read_track(folder / "track.csv");
  flight.snr = read_snr(folder / "snr.csv");
  read_journal(folder / "journal.lcmlog", flight);
  return flight;
}

}  // namespace earshot::report
