// earshot candump FILE|INTERFACE: what goes over a CAN bus, in words; and a recording of it.

#include <net/if.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/standard_streams.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "hil/bus/candump/line_reader.hpp"
#include "hil/bus/decode/dump.hpp"
#include "hil/bus/recorders/log_reader.hpp"
#include "hil/bus/recorders/unread_format.hpp"

namespace {

using namespace earshot;

struct Settings {
  std::string input;
  std::vector<std::string> pgns;
  std::optional<std::uint32_t> source;
  std::string format = "text";
  std::string times = "log";
  std::optional<std::filesystem::path> record;
  bool replace = false;
  std::optional<std::uint64_t> count;
};

constexpr std::uint64_t kMostComplaints = 100;  ///< a file that is none of candump's has a million lines; all are counted

/// The lines of a file that are damaged. They are told of one that is a log, once the first of its lines was read.
struct Damage {
  std::string file;
  std::uint64_t line = 0;  ///< that was read last
  std::uint64_t damaged = 0;
  bool is_of_log = false;
  std::string unprinted = {};

  void note(std::string_view why) {
    std::ostringstream text;
    if (++damaged <= kMostComplaints) text << host::printable(file) << ':' << line << ": " << why << "; passed over\n";
    if (damaged == kMostComplaints) text << host::printable(file) << ": of more that is damaged only the number is given\n";
    unprinted += text.str();
  }
  void show() {
    if (!is_of_log) return;
    std::cerr << unprinted;
    unprinted.clear();
  }
  /// @throws host::BadInput of a file in which there is nothing else
  void require_log() const {
    if (is_of_log || damaged == 0) return;
    throw host::BadInput(host::printable(file) + ": is no log that is read here: of its " + host::counted(line, "line") +
                         " none holds a frame or a message");
  }
  /// @return what the line says; nothing: it is empty or damaged
  std::optional<std::variant<hil::LogEntry, hil::Remark>> read(const hil::TextLine& text, hil::LogReader& reader) {
    ++line;
    if (text.is_too_long) {
      note("no line of a log is that long");
      return std::nullopt;
    }
    if (text.text.find_first_not_of(" \t\r") == std::string_view::npos) return std::nullopt;
    hil::LineOr line_read = reader.read(text.text);
    if (const auto* const why = std::get_if<std::string_view>(&line_read)) {
      note(*why);
      return std::nullopt;
    }
    if (auto* const remark = std::get_if<hil::Remark>(&line_read)) return *remark;
    is_of_log = true;
    return std::move(std::get<hil::LogEntry>(line_read));
  }
};

std::string name_of(const Settings& settings) {
  return settings.input == "-" ? "standard input" : settings.input;
}

class Work {
 public:
  explicit Work(const Settings& settings)
      : settings_(settings),
        printer_(hil::printer_of(format(), times())),
        record_(recording()),
        dump_(shown(), *printer_, program::print(), record_.get()) {}

  /// @param piece  what was read already; the rest comes into it
  template <class Read>
  int read_lines(Read read, std::vector<std::uint8_t>& piece, std::size_t size) {
    Damage damage{.file = name_of(settings_)};
    hil::LineReader lines;
    hil::LogReader reader;
    for (;; size = read(piece)) {
      lines.add({reinterpret_cast<const char*>(piece.data()), size});
      if (size == 0) lines.end();
      for (hil::TextLine line; !is_enough() && lines.next(line);) take(line, reader, damage);
      if (!flush()) return program::kLost;
      if (size == 0 || is_enough()) break;
    }
    damage.require_log();
    return end(damage.damaged == 0 ? "" : host::counted(damage.damaged, "damaged line") + ", ", damage.damaged == 0);
  }

  int listen(host::CanSocket& socket);

 private:
  [[nodiscard]] hil::Format format() const {
    return settings_.format == "text" ? hil::Format::kText : settings_.format == "json" ? hil::Format::kJson : hil::Format::kCsv;
  }
  [[nodiscard]] hil::Times times() const {
    if (settings_.times == "relative") return hil::Times::kRelative;
    if (settings_.times == "utc") return hil::Times::kUtc;
    return settings_.times == "local" ? hil::Times::kLocal : hil::Times::kAsLogged;
  }
  [[nodiscard]] hil::Shown shown() const {
    hil::Shown shown{.pgns = {}, .source = settings_.source};
    for (const std::string& pgn : settings_.pgns) shown.pgns.insert(static_cast<std::uint32_t>(*program::whole_number(pgn)));
    return shown;
  }
  [[nodiscard]] std::unique_ptr<hil::Recording> recording() const {
    if (!settings_.record) return nullptr;
    using enum hil::OlderRecording;
    return std::make_unique<hil::Recording>(*settings_.record, settings_.replace ? kIsReplaced : kIsKept);
  }

  [[nodiscard]] bool is_enough() const { return settings_.count && dump_.printed() >= *settings_.count; }

  /// Everything heard so far goes out before anything is waited for.
  [[nodiscard]] bool flush() {
    if (record_ == nullptr) {
      if (program::print().flush().good() || program::talk() == program::Talk::kQuiet) return true;
      std::cerr << "earshot candump: standard output cannot be written\n";
      return false;
    }
    program::print().flush();
    try {
      record_->flush();
    } catch (const host::BadInput& e) {
      std::cerr << e.what() << "; the recording ends after " << record_->frames() << " frames\n";
      return false;
    }
    return true;
  }

  void take(const hil::TextLine& line, hil::LogReader& reader, Damage& damage) {
    if (const auto read = damage.read(line, reader)) {
      if (const auto* const remark = std::get_if<hil::Remark>(&*read))
        lost_before_ += remark->lost_frames;
      else if (!dump_.take(std::get<hil::LogEntry>(*read)))
        damage.note("more than 16 interfaces");
    }
    damage.show();
  }

  int end(const std::string& what_is_wrong, bool is_complete) {
    if (record_ != nullptr) {
      try {
        record_->finish();
      } catch (const host::BadInput& e) {
        std::cerr << e.what() << "\n";
        return program::kLost;
      }
    }
    const hil::DecoderCounters counters = dump_.counters();
    if (is_complete && lost_before_ == 0 && program::talk() == program::Talk::kQuiet) return program::kDone;
    std::cerr << "earshot candump: " << what_is_wrong << host::counted(counters.frames, "frame") << ", "
              << host::counted(counters.messages, "message") << " (" << counters.unknown << " unknown)";
    if (counters.other_frames > 0)
      std::cerr << ", " << host::counted(counters.other_frames, "frame") << " of another kind than NMEA 2000's";
    if (counters.incomplete > 0) std::cerr << ", " << host::counted(counters.incomplete, "piece") << " of fast packets that were not whole";
    if (lost_before_ > 0) std::cerr << ", " << host::counted(lost_before_, "frame") << " lost by who recorded (DROPCOUNT)";
    if (dump_.unrecorded() > 0) std::cerr << ", " << host::counted(dump_.unrecorded(), "message") << " too long for a recording";
    if (record_ != nullptr) std::cerr << "; " << host::counted(record_->frames(), "frame") << " recorded";
    std::cerr << "\n";
    return is_complete ? program::kDone : program::kIncomplete;
  }

  const Settings& settings_;
  std::unique_ptr<hil::Printer> printer_;
  std::unique_ptr<hil::Recording> record_;
  hil::Dump dump_;
  std::uint64_t lost_before_ = 0;  ///< frames, says the log
};

/// Until Ctrl-C, SIGTERM or --count. An interface that goes down is waited for.
int Work::listen(host::CanSocket& socket) {
  constexpr int kPauseMs = 200;
  constexpr std::size_t kFramesAtOnce = 1024;
  program::stop_on_signals();
  bool was_up = true;
  hil::LogEntry entry{.time = Time{}, .interface = settings_.input, .frame = n2k::Frame{}};
  while (!program::stop_requested && !is_enough()) {
    std::size_t budget = kFramesAtOnce;
    for (Time arrival; !is_enough() && socket.receive(*entry.frame, arrival, budget) == Status::kOk;) {
      entry.time = arrival.us < 0 ? std::nullopt : std::optional(arrival);
      (void)dump_.take(entry);
    }
    if (!flush()) return program::kLost;
    if (budget == 0) continue;
    if (!socket.is_up()) (void)socket.reopen();
    if (was_up != socket.is_up())
      std::cerr << settings_.input << (was_up ? ": is down, or its controller has left the bus; waiting for it\n" : ": is up again\n");
    was_up = socket.is_up();
    pollfd waiting{.fd = was_up ? socket.file_descriptor() : -1, .events = POLLIN, .revents = 0};
    (void)::poll(&waiting, 1, kPauseMs);
  }
  const std::uint64_t lost = socket.counters().lost_by_kernel;
  return end(lost == 0 ? "" : std::to_string(lost) + " frames lost, because they came faster than they were taken; ", lost == 0);
}

/// A name with a slash in it is a file's; else an interface of that name goes before a file.
bool is_interface(const std::string& input) {
  return input.find('/') == std::string::npos && (::if_nametoindex(input.c_str()) != 0 || !std::filesystem::exists(input));
}

std::string complaint_about_pgn(const std::string& text) {
  const auto pgn = program::whole_number(text);
  return pgn && *pgn >= 0 && *pgn <= 0x3FFFF ? "" : text + ": a parameter group's number is 0 to 262143";
}

std::size_t read_standard_input(std::vector<std::uint8_t>& into) {
  for (;;) {
    const ssize_t size = ::read(STDIN_FILENO, into.data(), into.size());
    if (size >= 0) return static_cast<std::size_t>(size);
    if (errno != EINTR) throw host::BadInput(std::string("standard input: cannot be read: ") + std::strerror(errno));
  }
}

/// Of a file that is read whole.
void require_log(const Settings& settings, std::string_view text) {
  Damage damage{.file = name_of(settings)};
  hil::LineReader lines;
  hil::LogReader reader;
  lines.add(text);
  lines.end();
  for (hil::TextLine line; !damage.is_of_log && lines.next(line);) {
    if (const auto read = damage.read(line, reader); read && std::holds_alternative<hil::LogEntry>(*read)) return;
  }
  damage.require_log();
}

/// Judges what it is before anything is printed or recorded.
template <class Read>
int read_log(const Settings& settings, Read read) {
  constexpr std::size_t kPiece = 65'536;
  std::vector<std::uint8_t> piece(kPiece);
  const std::size_t size = read(piece);
  const std::string_view what = hil::unread_format({reinterpret_cast<const char*>(piece.data()), size});
  if (!what.empty()) throw host::BadInput(name_of(settings) + ": " + std::string(what));
  if (settings.input != "-" && size < piece.size()) require_log(settings, {reinterpret_cast<const char*>(piece.data()), size});
  return Work(settings).read_lines(read, piece, size);
}

/// --replace would empty the log that is read.
void require_not_recorded(const Settings& settings, const std::string& name, const std::filesystem::path& log) {
  if (!settings.record) return;
  host::DistinctFiles files;
  files.read(name, log);
  files.write("--record", *settings.record);
}

int work(const Settings& settings) {
  if (settings.input == "-") {
    require_not_recorded(settings, "standard input", "/dev/stdin");
    return read_log(settings, read_standard_input);
  }
  if (!is_interface(settings.input)) {
    host::InputFile file(settings.input, host::kAnySize);
    require_not_recorded(settings, "INPUT", settings.input);
    return read_log(settings, [&file](std::vector<std::uint8_t>& into) { return file.read(into); });
  }
  std::optional<host::CanSocket> socket;
  try {
    socket.emplace(settings.input);
  } catch (const std::exception& e) {
    throw host::BadInput(settings.input + ": there is no such file, and as an interface: " + e.what());
  }
  // Who reads what is printed may let a recording wait, but not for ever.
  const program::NonBlockingStdio streams;
  return Work(settings).listen(*socket);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  program::CommandLine line("earshot candump",
                            "Prints in words what goes over a CAN bus (NMEA 2000), and records it as candump -l does.\n"
                            "Status: 0 done, also after Ctrl-C; 1 lines were damaged, or frames were lost; 2 the input was refused; 3 the\n"
                            "recording, or standard output, could not be written.");
  line.option("INPUT", &settings.input,
              "a log of candump (-l, -L), what it printed, another recorder's log, - for standard input, or an interface (./NAME: a file)")
      .required();
  line.option("--pgn", &settings.pgns, "show these parameter groups only: 129025,129026").separated_by(',').checked(complaint_about_pgn);
  line.option("--source", &settings.source, "show what this address sends only").from(0, 255);
  line.option("--format", &settings.format, "text; json: an object a line; csv: a row a signal")
      .one_of({"text", "json", "csv"})
      .shows_default();
  line.option("--times", &settings.times, "log: as they stand there; relative: since the first message; utc; local")
      .one_of({"log", "relative", "utc", "local"})
      .shows_default();
  line.option("-n,--count", &settings.count, "end after so many messages that are shown (with --pgn and --source those alone)");
  const auto record = line.option("--record", &settings.record, "write every NMEA 2000 frame to this log, which canplayer takes");
  line.flag("--replace", &settings.replace, "--record may replace a file").needs(record);
  line.footer(
      "earshot candump can0                          what goes over the bus now\n"
      "earshot candump can0 --record sea.log --quiet a recording beside a flight\n"
      "earshot candump sea.log --pgn 129025,129029   positions of a recording\n"
      "candump -L can0 | earshot candump - --format json");
  return program::run(line, argc, argv, [&] { return work(settings); });
}
