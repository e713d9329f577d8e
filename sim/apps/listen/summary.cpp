#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/listen/outputs.hpp"
#include "sim/recording/utc.hpp"

namespace earshot::listen {
namespace {

using nlohmann::ordered_json;

/// JSON knows no NaN.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json score_json(const annotation::Score& score) {
  return {{"selections", score.truths},
          {"detections", score.detections},
          {"hits", score.hits},
          {"misses", score.misses()},
          {"false_alarms", score.false_alarms()},
          {"recall", number(score.recall())},
          {"precision", number(score.precision())},
          {"false_alarms_per_hour", number(score.false_alarms_per_hour())}};
}

ordered_json files_json(const recording::Sequence& sequence) {
  ordered_json files = ordered_json::array();
  for (const recording::Part& part : sequence.parts()) {
    ordered_json file = {{"path", part.path.string()},
                         {"begin_s", (sequence.time_of(part.begin) - Time{}).to_seconds()},
                         {"samples", part.frames},
                         {"recorder", part.notes.recorder},
                         {"start_utc", nullptr}};
    if (part.first_frame > 0) file["first_sample"] = part.first_frame;
    if (part.notes.start) {
      file["start_utc"] = recording::to_iso(*part.notes.start);
      file["start_from"] = part.notes.start_from;
    }
    files.push_back(std::move(file));
  }
  return files;
}

ordered_json detections_json(const Result& result) {
  ordered_json rows = ordered_json::array();
  for (const listening::Row& row : result.heard.rows) {
    rows.push_back({{"begin_s", row.begin_s},
                    {"duration_s", row.duration_s},
                    {"peak_s", row.peak_s},
                    {"snr_db", row.snr_db},
                    {"level_db", row.level_db},
                    {"file", result.plan.sequence.parts()[row.place.part].path.string()},
                    {"file_offset_s", row.place.offset.to_seconds()},
                    {"begin_utc", row.place.utc ? ordered_json(recording::to_iso(*row.place.utc)) : ordered_json(nullptr)},
                    {"validity", row.is_clipped ? "clipped" : "good"}});
  }
  return rows;
}

void add_score(ordered_json& json, const Result& result, const Arguments& arguments) {
  if (!result.score) return;
  json["score"] = score_json(*result.score);
  json["score"]["tolerance_s"] = arguments.tolerance_s;
  if (result.curve.empty()) return;
  json["curve"] = ordered_json::array();
  for (const annotation::OperatingPoint& point : result.curve) {
    ordered_json row = {{"threshold_db", point.threshold_db}};
    row.update(score_json(point.score));
    json["curve"].push_back(std::move(row));
  }
}

void print_recording(std::ostream& out, const Result& result) {
  const recording::Sequence& sequence = result.plan.sequence;
  const recording::Part& first = sequence.parts().front();
  out << "recording:   " << first.path.string();
  if (sequence.files() > 1) out << " and " << sequence.files() - 1 << " more files";
  out << ": " << sequence.duration().to_seconds() << " s at " << sequence.sample_rate().value << " Hz, "
      << recording::to_string(first.format);
  if (sequence.channels() > 1) out << ", channel " << result.plan.channel + 1 << " of " << sequence.channels();
  out << '\n';
  if (!first.notes.recorder.empty())
    out << "recorder:    " << first.notes.recorder << (first.notes.gain.empty() ? "" : ", ") << first.notes.gain << '\n';
  if (first.notes.start)
    out << "begins:      " << recording::to_iso(*first.notes.start) << ", from " << first.notes.start_from << '\n';
  else
    out << "begins:      not known: neither the header nor the name gives it (--begin, --time-format)\n";
}

void print_levels(std::ostream& out, const Result& result, const Arguments& arguments) {
  const listening::Plan& plan = result.plan;
  if (plan.chain.is_calibrated())
    out << "calibration: full scale is " << plan.chain.full_scale_level->value << " dB re 1 uPa (peak), from " << plan.chain.from << '\n';
  else
    out << "calibration: uncalibrated: levels are dB re full scale\n";
  out << "listens for: " << arguments.preset << ", " << plan.settings.band.low.value << " to " << plan.settings.band.high.value << " Hz";
  if (plan.settings.band != plan.asked)
    out << " (of " << plan.asked.low.value << " to " << plan.asked.high.value << " Hz: the sample rate holds no more)";
  out << ", SNR of " << plan.settings.detection_threshold.value << " dB or more over " << plan.settings.integration_time.to_seconds()
      << " s\n"
      << "noise:       " << result.heard.noise_db << ' ' << plan.chain.unit() << " in the band\n"
      << "heard:       " << result.heard.listened_s << " s";
  for (const listening::Heard::Obstacle& obstacle : result.heard.obstacles)
    out << "; " << obstacle.what << ": " << obstacle.seconds << " s";
  out << '\n';
}

void print_rows(std::ostream& out, const Result& result) {
  out << "detections:  " << result.heard.rows.size() << '\n';
  if (result.heard.rows.empty()) return;
  out << "   begin (s)  duration (s)  SNR (dB)  level (" << result.plan.chain.unit() << ")\n";
  for (const listening::Row& row : result.heard.rows) {
    out << std::setw(12) << row.begin_s << std::setw(14) << row.duration_s << std::setw(10) << row.snr_db << std::setw(8) << row.level_db;
    if (row.is_clipped) out << "  clipped";
    if (row.place.utc) out << "  " << recording::to_iso(*row.place.utc);
    out << '\n';
  }
}

std::string share(double value) {
  if (!std::isfinite(value)) return "none";
  return host::decimals(100.0 * value, 1) + " %";
}

void print_score(std::ostream& out, const annotation::Score& score, double tolerance_s) {
  out << "score:       " << score.hits << " of " << score.truths << " selections found, " << score.false_alarms()
      << " detections without one; tolerance " << tolerance_s << " s\n"
      << "             recall " << share(score.recall()) << ", precision " << share(score.precision()) << ", "
      << score.false_alarms_per_hour() << " false alarms per hour\n";
}

}  // namespace

std::string json_of(const Result& result, const Arguments& arguments) {
  const listening::Plan& plan = result.plan;
  ordered_json obstacles = ordered_json::object();
  for (const listening::Heard::Obstacle& obstacle : result.heard.obstacles) obstacles[obstacle.what] = obstacle.seconds;
  ordered_json json = {{"earshot_listen", program::version()},
                       {"command", arguments.history},
                       {"files", files_json(plan.sequence)},
                       {"sample_rate_hz", plan.sequence.sample_rate().value},
                       {"duration_s", plan.sequence.duration().to_seconds()},
                       {"channel", plan.channel + 1},
                       {"preset", arguments.preset},
                       {"band_hz", {plan.settings.band.low.value, plan.settings.band.high.value}},
                       {"threshold_db", plan.settings.detection_threshold.value},
                       {"integration_time_s", plan.settings.integration_time.to_seconds()},
                       {"level_unit", plan.chain.unit()},
                       {"full_scale_level_db_re_1upa",
                        plan.chain.is_calibrated() ? ordered_json(plan.chain.full_scale_level->value) : ordered_json(nullptr)},
                       {"noise_db", number(result.heard.noise_db)},
                       {"listened_s", result.heard.listened_s},
                       {"not_heard_s", std::move(obstacles)},
                       {"detections", detections_json(result)}};
  add_score(json, result, arguments);
  // Names of files may be no UTF-8.
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string summary_of(const Result& result, const Arguments& arguments) {
  std::ostringstream out;
  print_recording(out, result);
  out << std::fixed << std::setprecision(1);
  print_levels(out, result, arguments);
  print_rows(out, result);
  if (result.score) print_score(out, *result.score, arguments.tolerance_s);
  return host::printable_lines(out.str());
}

}  // namespace earshot::listen
