#include "sim/recording/recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "sim/recording/clock_text.hpp"
#include "sim/recording/text_scanner.hpp"
#include "sim/recording/utc.hpp"

namespace earshot::recording {
namespace {

/// A SoundTrap's log has some hundred lines.
constexpr host::FileKind kLogFile{"a SoundTrap's log", std::uint64_t{4} << 20U};

bool is_sensitivity(double db) {
  return db >= -260.0 && db <= -100.0;
}

bool is_voltage(double volts) {
  return volts >= 1e-6 && volts <= 1e3;
}

void read_iclisten(const SoundTexts& texts, const SoundFormat& format, RecorderNotes& notes) {
  double volts = 0.0;
  double sensitivity_db = 0.0;
  TextScanner comment(texts.comment);
  comment.blanks().decimal(volts).word(" V pk,").blanks().decimal(sensitivity_db).word(" dBV re 1uPa");
  if (!comment.is_ok() || !is_voltage(volts) || !is_sensitivity(sensitivity_db)) return;
  notes.recorder = "icListen";
  notes.sensitivity = Decibels{sensitivity_db};
  notes.full_scale_volts = volts;
  // The count at those volts: less than full scale where 16 bits were taken off 24 with gain.
  const std::size_t at = texts.comment.find(" = Max Count");
  if (at != std::string::npos && !format.is_float) {
    const std::size_t begin = texts.comment.find_last_not_of("0123456789", at == 0 ? 0 : at - 1);
    double count = 0.0;
    TextScanner scanner(std::string_view(texts.comment).substr(begin == std::string::npos ? 0 : begin + 1));
    const double scaled = scanner.decimal(count).is_ok() && count > 0.0 ? volts * std::exp2(format.bits - 1) / count : 0.0;
    if (is_voltage(scaled)) notes.full_scale_volts = scaled;
  }
  if (const std::optional<ClockTime> date = read_iso(texts.date)) {
    notes.start = date->utc;
    notes.start_from = "its header";
  }
}

/// "HH:MM:SS dd/mm/yyyy" and the zone in brackets; the first firmware told none and ran in UTC. Some write milliseconds.
std::optional<Time> audiomoth_time(std::string_view text) {
  Calendar c;
  int fraction = 0;
  TextScanner comment(text);
  comment.after("Recorded at ").digits(2, c.hour).word(":").digits(2, c.minute).word(":").digits(2, c.second);
  if (comment.comes_next(".")) comment.word(".").digits(3, fraction);
  comment.word(" ").digits(2, c.day).word("/").digits(2, c.month).word("/").digits(4, c.year).blanks();
  Duration zone;
  if (comment.comes_next("(")) {
    const std::optional<Duration> read = read_zone(comment.word("("));
    if (!read || !comment.blanks().word(")").is_ok()) return std::nullopt;
    zone = *read;
  }
  const std::optional<Time> clock = comment.is_ok() ? utc(c) : std::nullopt;
  return clock ? std::optional(Time{clock->us + Duration::milliseconds(fraction).us - zone.us}) : std::nullopt;
}

void read_audiomoth(const SoundTexts& texts, RecorderNotes& notes) {
  const auto is_named = [&texts](const char* name) {
    return texts.comment.find(name) != std::string::npos || texts.artist.find(name) != std::string::npos;
  };
  // Where a deployment has a number, it stands in place of the device's.
  if (!is_named("AudioMoth") && !is_named("HydroMoth") && texts.comment.find("Recorded at ") == std::string::npos) return;
  notes.recorder = is_named("HydroMoth") ? "HydroMoth" : "AudioMoth";
  notes.start = audiomoth_time(texts.comment);
  if (notes.start) notes.start_from = "its comment";
  int gain = 0;
  TextScanner setting(texts.comment);
  if (setting.after("at gain setting ").integer(gain).is_ok()) notes.gain = "gain setting " + std::to_string(gain);
  for (const char* word : {"low gain", "low-medium gain", "medium gain", "medium-high gain", "high gain"})
    if (texts.comment.find(std::string(" at ") + word) != std::string::npos) notes.gain = word;
}

/// What stands between quotation marks behind `name=`.
std::string_view attribute(std::string_view xml, std::string_view name) {
  TextScanner scanner(xml);
  if (!scanner.after(name).word("=\"").is_ok()) return {};
  return scanner.rest().substr(0, scanner.rest().find('"'));
}

/// "SERIAL.yymmddHHMMSS" @return when it was recorded, by its own clock
std::optional<Time> soundtrap_name(std::string_view stem) {
  Calendar c;
  int serial = 0;
  TextScanner scanner(stem);
  scanner.integer(serial)
      .word(".")
      .digits(2, c.year)
      .digits(2, c.month)
      .digits(2, c.day)
      .digits(2, c.hour)
      .digits(2, c.minute)
      .digits(2, c.second);
  c.year += 2000;
  return scanner.is_ok() && scanner.rest().empty() ? utc(c) : std::nullopt;
}

void read_soundtrap(const std::filesystem::path& path, RecorderNotes& notes) {
  const std::optional<Time> named = soundtrap_name(path.stem().string());
  if (!named) return;
  notes.recorder = "SoundTrap";
  notes.start = named;
  notes.start_from = "its name, taken as UTC";
  const std::filesystem::path log = log_beside(path);
  if (!std::filesystem::exists(log)) return;
  const std::string xml = host::read_text(log, kLogFile);
  if (const std::optional<ClockTime> start = read_iso(attribute(xml, "SamplingStartTimeUTC"))) {
    int microseconds = 0;
    const bool has_fraction = TextScanner(attribute(xml, "SamplingStartTimeSubS")).blanks().integer(microseconds).is_ok();
    const bool is_fraction = has_fraction && microseconds >= 0 && microseconds < 1'000'000;
    notes.start = Time{start->utc.us + (is_fraction ? microseconds : 0)};
    notes.start_from = log.filename().string();
  }
  if (const std::string_view gain = attribute(xml, "Gain"); !gain.empty()) notes.gain = "gain " + std::string(gain);
}

/// What stands behind "Key:" in a line of its own.
std::string_view guano_value(std::string_view guano, std::string_view key) {
  while (!guano.empty()) {
    const std::size_t end = std::min(guano.find_first_of("\r\n"), guano.size());
    const std::string_view line = guano.substr(0, end);
    guano.remove_prefix(std::min(end + 1, guano.size()));
    if (!line.starts_with(key) || !line.substr(key.size()).starts_with(":")) continue;
    TextScanner value(line.substr(key.size() + 1));
    return value.blanks().rest();
  }
  return {};
}

void read_guano_maker(std::string_view guano, RecorderNotes& notes) {
  notes.recorder = guano_value(guano, "Make");
  const std::string_view model = guano_value(guano, "Model");
  if (!notes.recorder.empty() && !model.empty()) notes.recorder += ' ';
  notes.recorder += model;
}

/// The first that states its zone, else the first of all, which is taken as UTC.
void read_stated_time(const std::filesystem::path& path, const SoundTexts& texts, RecorderNotes& notes) {
  struct Statement {
    std::optional<ClockTime> time;
    const char* from;
  };
  const std::array statements{Statement{read_iso(guano_value(texts.guano, "Timestamp")), "its GUANO Timestamp"},
                              Statement{read_iso(texts.date), "its header (ICRD)"},
                              Statement{time_in_name(path.stem().string()), "its name"},
                              Statement{read_iso(texts.origin), "its header (bext)"}};
  for (const bool has_zone : {true, false}) {
    for (const Statement& statement : statements) {
      if (notes.start || !statement.time || statement.time->has_zone != has_zone) continue;
      notes.start = statement.time->utc;
      notes.start_from = statement.from + std::string(has_zone ? "" : ", taken as UTC");
    }
  }
}

}  // namespace

std::filesystem::path log_beside(const std::filesystem::path& recording) {
  return std::filesystem::path(recording).replace_extension(".log.xml");
}

RecorderNotes notes_of(const std::filesystem::path& path, const SoundTexts& texts, const SoundFormat& format) {
  RecorderNotes notes;
  read_iclisten(texts, format, notes);
  if (notes.recorder.empty()) read_audiomoth(texts, notes);
  if (notes.recorder.empty()) read_soundtrap(path, notes);
  if (notes.recorder.empty()) read_guano_maker(texts.guano, notes);
  if (!notes.start) read_stated_time(path, texts, notes);
  return notes;
}

}  // namespace earshot::recording
