#include "sim/apps/listen/arguments.hpp"

#include <string_view>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/apps/listen/outputs.hpp"
#include "sim/plot/gnuplot.hpp"
#include "sim/recording/clock_text.hpp"
#include "sim/recording/recorder.hpp"
#include "sim/recording/sound_folder.hpp"

namespace earshot::listen {
namespace {

program::Option within(program::Option option, const host::Range& range) {
  return option.between(range.lowest, range.highest);
}

std::string picture_name(const std::string& path) {
  return plot::is_picture_name(path) ? std::string() : path + ": a picture's name must end in .png or .svg";
}

void describe_hearing(program::CommandLine& line, Arguments& a) {
  line.option("--preset", &a.preset,
              "what is listened for. fin: pulses of 1 s at 15-30 Hz, which finds most calls in that band; blue: A and B calls, 14-17 Hz; "
              "antarctic: Z calls, 17-29 Hz; tone: one that does not end, 18-22 Hz")
      .one_of(listening::preset_names())
      .shows_default();
  within(line.option("--band", &a.band_hz, "listen from LOW to HIGH Hz in place of the preset's band").takes(2, 2),
         listening::kBandEdges_hz);
  within(line.option("--threshold", &a.threshold_db, "SNR of a detection in dB; default: 10"), listening::kThresholds_db);
  line.option("--channel", &a.channel, "which of the recording's channels, from 1").from(1, listening::kMostChannels).shows_default();
  line.option("--calibration", &a.calibration,
              "TOML file: full_scale_level_db_re_1upa, or sensitivity_db_re_1v_per_upa, gain_db and full_scale_v; default: what the "
              "recorder wrote into the file");
  within(line.option("--full-scale-db", &a.full_scale_level_db,
                     "level of a sample of full scale, dB re 1 uPa peak (a SoundTrap's end-to-end calibration), in place of a file"),
         listening::kFullScaleLevels_db);
  line.at("--full-scale-db").excludes(line.at("--calibration"));
}

void describe_times(program::CommandLine& line, Arguments& a) {
  line.option("--begin", &a.begin,
              "when the file begins, such as 2021-02-05T03:59:46+10:00; without a zone it is UTC; default: what the file states")
      .checked([](const std::string& text) {
        const std::string fault = recording::fault_of_iso(text);
        return fault.empty() ? fault : text + ": " + fault;
      });
  line.option("--time-format", &a.time_format,
              "how the files' names give the time when they begin, such as %y%m%d_%H%M%S or %Y%j%H%M%S%z; without %z it is UTC; %f is a "
              "fraction")
      .checked([](const std::string& text) {
        const std::string fault = recording::fault_of_format(text);
        return fault.empty() ? fault : text + ": " + fault;
      });
  line.at("--begin").excludes(line.at("--time-format"));
}

void describe_outputs(program::CommandLine& line, Arguments& a) {
  line.option("--csv", &a.csv, "write the detections, a line each");
  line.option("--raven", &a.raven, "write them as a Raven selection table");
  line.option("--json", &a.json, "write them, the settings and the score as JSON");
  line.option("--spectrogram", &a.spectrogram, "draw the recording with a bar above and below each detection, as .png or .svg")
      .checked(picture_name);
  line.option("--levels", &a.levels, "write third-octave levels over time, means and percentiles, as NetCDF");
  within(line.option("--levels-interval-s", &a.levels_interval_s, "of those levels"), listening::kLevelsIntervals_s).shows_default();
  line.at("--levels-interval-s").needs(line.at("--levels"));
  line.flag("--force", &a.force, "replace a file that is there already, of whatever kind it is");
}

void describe_score(program::CommandLine& line, Arguments& a) {
  line.option("--score", &a.truth,
              "Raven selection table, Audacity labels or CSV (start,end,label) of what is truly there: prints recall, precision and false "
              "alarms per hour");
  within(line.option("--tolerance-s", &a.tolerance_s,
                     "a detection and a selection are one if they overlap or lie no further apart; each counts once"),
         listening::kTolerances_s)
      .shows_default();
  line.option("--roc", &a.roc, "also draw recall against false alarms over thresholds, as .png or .svg").checked(picture_name);
  line.at("--tolerance-s").needs(line.at("--score"));
  line.at("--roc").needs(line.at("--score"));
}

}  // namespace

void describe(program::CommandLine& line, Arguments& a) {
  line.footer(
      "Examples:\n"
      "  earshot listen song.wav --threshold 6 --raven song.txt --spectrogram song.png\n"
      "  earshot listen 5100.*.wav --full-scale-db 176.1 --csv detections.csv --levels levels.nc\n"
      "  earshot listen song.flac --score annotations.txt --roc roc.png --json score.json");
  line.option("FILE", &a.files, "recordings, WAV or FLAC, or folders of such; several of one recorder are one sequence")
      .required()
      .takes(1, -1);
  describe_times(line, a);
  describe_hearing(line, a);
  describe_outputs(line, a);
  describe_score(line, a);
}

void open_folders(Arguments& a) {
  const std::vector<std::filesystem::path> named(a.files.begin(), a.files.end());
  a.files.clear();
  for (const std::filesystem::path& path : recording::recordings_in(named)) a.files.push_back(path.string());
}

void require_writable(const Arguments& a) {
  host::DistinctFiles read;
  for (const std::string& file : a.files) {
    read.read("FILE", file);
    read.read("the log beside FILE", recording::log_beside(file));
  }
  if (!a.truth.empty()) read.read("--score", a.truth);
  if (!a.calibration.empty()) read.read("--calibration", a.calibration);
  std::vector<host::Output> outputs;
  const auto add = [&outputs](const char* option, const std::string& path, const host::OutputKind& kind) {
    if (!path.empty()) outputs.push_back({option, path, kind});
  };
  add("--csv", a.csv, kCsvOutput);
  add("--raven", a.raven, annotation::kSelectionOutput);
  add("--json", a.json, kJsonOutput);
  add("--spectrogram", a.spectrogram, host::picture_kind(a.spectrogram));
  add("--levels", a.levels, host::kNetcdfOutput);
  add("--roc", a.roc, host::picture_kind(a.roc));
  host::require_writable(std::move(read), outputs, host::replaced_by(a.force));
}

listening::Request request_of(const Arguments& a) {
  listening::Request request{.preset = a.preset, .band = {}, .threshold = {}, .channel = a.channel, .chain = {}};
  if (!a.band_hz.empty()) request.band = {.low = Hertz{a.band_hz[0]}, .high = Hertz{a.band_hz[1]}};
  if (a.threshold_db) request.threshold = Decibels{*a.threshold_db};
  if (!a.calibration.empty())
    request.chain = listening::read_calibration(host::TomlFile(a.calibration));
  else if (a.full_scale_level_db)
    request.chain = {.full_scale_level = Decibels{*a.full_scale_level_db}, .from = "--full-scale-db"};
  return request;
}

}  // namespace earshot::listen
