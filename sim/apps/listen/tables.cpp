
#include "firmware/host/text/numbers.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/apps/listen/outputs.hpp"
#include "sim/recording/utc.hpp"

namespace earshot::listen {
namespace {

/// RFC 4180: a cell that holds a comma, a quotation mark or a line break stands between quotation marks.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

const char* validity(const listening::Row& row) {
  return row.is_clipped ? "clipped" : "good";
}

}  // namespace

std::string csv_of(const Result& result) {
  const std::string level = result.plan.chain.is_calibrated() ? "level_db_re_1upa" : "level_db_re_full_scale";
  std::string text = "begin_s,duration_s,begin_utc,peak_s,snr_db," + level + ",file,file_offset_s,validity\n";
  for (const listening::Row& row : result.heard.rows) {
    const recording::Part& part = result.plan.sequence.parts()[row.place.part];
    text += host::decimals(row.begin_s, 3) + "," + host::decimals(row.duration_s, 3) + "," +
            (row.place.utc ? recording::to_iso(*row.place.utc) : "") + "," + host::decimals(row.peak_s, 3) + "," +
            host::decimals(row.snr_db, 2) + "," + host::decimals(row.level_db, 2) + "," + csv_cell(part.path.string()) + "," +
            host::decimals(row.place.offset.to_seconds(), 3) + "," + validity(row) + "\n";
  }
  return text;
}

std::string raven_of(const Result& result) {
  const listening::Plan& plan = result.plan;
  annotation::SelectionTable table{.columns = {"SNR (dB)", std::string("Level (") + plan.chain.unit() + ")", "Validity"}, .selections = {}};
  for (const listening::Row& row : result.heard.rows) {
    table.selections.push_back({.begin_s = row.begin_s,
                                .end_s = row.begin_s + row.duration_s,
                                .low_hz = plan.settings.band.low.value,
                                .high_hz = plan.settings.band.high.value,
                                .channel = static_cast<int>(plan.channel) + 1,
                                .begin_file = plan.sequence.parts()[row.place.part].path.filename().string(),
                                .file_offset_s = row.place.offset.to_seconds(),
                                .values = {host::decimals(row.snr_db, 2), host::decimals(row.level_db, 2), validity(row)}});
  }
  return annotation::to_text(table);
}

}  // namespace earshot::listen
