#include "sim/recording/recorder.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
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

/// "yyyy-mm-ddTHH:MM:SS", with a blank in place of the T as well.
std::optional<Time> iso_time(std::string_view text) {
  Calendar c;
  TextScanner scanner(text);
  scanner.blanks().digits(4, c.year).word("-").digits(2, c.month).word("-").digits(2, c.day);
  scanner.word(scanner.comes_next("T") ? "T" : " ").digits(2, c.hour).word(":").digits(2, c.minute).word(":").digits(2, c.second);
  return scanner.is_ok() ? utc(c) : std::nullopt;
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
  notes.start = iso_time(texts.date);
  if (notes.start) notes.start_from = "its header";
}

/// "+2", "-3", "+5:30", or nothing before the bracket that closes.
Duration read_zone(TextScanner& comment) {
  int hours = 0;
  int minutes = 0;
  if (comment.comes_next(")")) return {};
  const bool is_west = comment.comes_next("-");
  comment.integer(hours);
  if (comment.comes_next(":")) comment.word(":").digits(2, minutes);
  return Duration::seconds(3600LL * hours + 60LL * (is_west ? -minutes : minutes));
}

void read_audiomoth(const SoundTexts& texts, RecorderNotes& notes) {
  if (texts.comment.find("AudioMoth") == std::string::npos) return;
  notes.recorder = "AudioMoth";
  Calendar c;
  TextScanner comment(texts.comment);
  comment.after("Recorded at ").digits(2, c.hour).word(":").digits(2, c.minute).word(":").digits(2, c.second).word(" ");
  comment.digits(2, c.day).word("/").digits(2, c.month).word("/").digits(4, c.year).word(" (UTC");
  const Duration zone = read_zone(comment);
  const std::optional<Time> local = comment.word(")").is_ok() ? utc(c) : std::nullopt;
  if (local) {
    notes.start = Time{local->us - zone.us};
    notes.start_from = "its comment";
  }
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
  const std::filesystem::path log = path.parent_path() / (path.stem().string() + ".log.xml");
  if (!std::filesystem::exists(log)) return;
  const std::string xml = host::read_text(log, kLogFile);
  if (const std::optional<Time> start = iso_time(attribute(xml, "SamplingStartTimeUTC"))) {
    int microseconds = 0;
    const bool has_fraction = TextScanner(attribute(xml, "SamplingStartTimeSubS")).blanks().integer(microseconds).is_ok();
    const bool is_fraction = has_fraction && microseconds >= 0 && microseconds < 1'000'000;
    notes.start = Time{start->us + (is_fraction ? microseconds : 0)};
    notes.start_from = log.filename().string();
  }
  if (const std::string_view gain = attribute(xml, "Gain"); !gain.empty()) notes.gain = "gain " + std::string(gain);
}

/// The first "yyyymmdd_HHMMSS" in a name, with a T or a dash between as well.
std::optional<Time> dated_name(std::string_view name) {
  for (std::size_t at = 0; at < name.size(); ++at) {
    Calendar c;
    TextScanner scanner(name.substr(at));
    scanner.digits(4, c.year).digits(2, c.month).digits(2, c.day);
    const bool is_parted = scanner.comes_next("_") || scanner.comes_next("T") || scanner.comes_next("-");
    if (!is_parted) continue;
    scanner.word(scanner.rest().substr(0, 1)).digits(2, c.hour).digits(2, c.minute).digits(2, c.second);
    if (const std::optional<Time> time = scanner.is_ok() ? utc(c) : std::nullopt) return time;
  }
  return std::nullopt;
}

}  // namespace

RecorderNotes notes_of(const std::filesystem::path& path, const SoundTexts& texts, const SoundFormat& format) {
  RecorderNotes notes;
  read_iclisten(texts, format, notes);
  if (notes.recorder.empty()) read_audiomoth(texts, notes);
  if (notes.recorder.empty()) read_soundtrap(path, notes);
  if (notes.start) return notes;
  notes.start = dated_name(path.stem().string());
  if (notes.start) notes.start_from = "its name, taken as UTC";
  return notes;
}

}  // namespace earshot::recording
