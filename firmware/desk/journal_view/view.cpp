#include "firmware/desk/journal_view/view.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/desk/journal_view/followed_journal.hpp"
#include "firmware/desk/journal_view/mission_origin.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/safety_record/words/record_words.hpp"

namespace earshot::journal {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPollInterval{200};  ///< how often who follows looks for more
/// A file system that cannot mark a file as being written has nobody writing it: a program that flies writes a record a second.
constexpr std::chrono::seconds kLongSilence{3};

/// What the journal lacks, for standard error.
class Lacks {
 public:
  explicit Lacks(std::string name) : name_(std::move(name)) {}
  void note(std::span<const Event> events) {
    constexpr std::uint64_t kMostReported = 10;
    for (const Event& event : events)
      if (event.is_lack && ++count_ <= kMostReported) reported_.push_back(event.text);
  }
  [[nodiscard]] int report() const {
    for (const std::string& lack : reported_) std::cerr << name_ << ": " << lack << "\n";
    if (count_ > reported_.size()) std::cerr << name_ << ": and " << count_ - reported_.size() << " more like these\n";
    return count_ == 0 ? program::kDone : program::kIncomplete;
  }

 private:
  std::string name_;
  std::uint64_t count_ = 0;
  std::vector<std::string> reported_;
};

/// What goes wrong when there is nothing to show.
host::BadInput no_record_in(const std::filesystem::path& journal) {
  return host::BadInput(journal.string() + ": not a journal: no record in it");
}

/// The files that are asked for, all judged before the first is begun.
class Exports {
 public:
  explicit Exports(const ViewOptions& options) {
    host::DistinctFiles read;
    read.read("JOURNAL", host::JournalParts(options.journal).files());
    const std::optional<n2k::LocalPlane> plane = options.plane ? options.plane : plane_beside(options.journal);
    std::vector<host::Output> outputs;
    for_each_asked(options, [&](const ExportKind& kind, const std::filesystem::path& path) {
      if (kind.origin == Origin::kNeeded && !plane)
        throw host::BadInput(std::string(kind.option) + " " + path.string() +
                             ": needs the mission's origin, which no journal holds, nor a summary.json beside this one: state it with "
                             "--origin LATITUDE_DEG,LONGITUDE_DEG");
      outputs.push_back({kind.option, path, kind.output});
    });
    host::require_writable(std::move(read), outputs, options.replace);
    for_each_asked(options, [&](const ExportKind& kind, const std::filesystem::path& path) {
      files_.push_back({path, kind.make(path, plane)});
    });
  }

  [[nodiscard]] bool empty() const { return files_.empty(); }
  void take(const Entry& entry, std::span<const Event> events) {
    for (const File& file : files_) file.content->take(entry, events);
  }
  void finish(std::span<const Event> events) {
    for (const File& file : files_) {
      file.content->finish(events);
      program::print() << host::printable(file.path.string()) << ": " << file.content->what() << "\n";
    }
  }

 private:
  struct File {
    std::filesystem::path path;
    std::unique_ptr<Export> content;
  };

  static void for_each_asked(const ViewOptions& options, const auto& take) {
    for (std::size_t i = 0; i < kExportKindCount; ++i)
      if (options.files[i]) take(kExportKinds[i], *options.files[i]);
  }

  std::vector<File> files_;
};

class Viewer {
 public:
  explicit Viewer(const ViewOptions& options)
      : options_(options),
        source_(options.journal, host::Accepts::kBusLogs),
        exports_(options),
        lacks_(host::printable(options.journal.string())),
        prints_(exports_.empty()) {}

  int run() {
    if (options_.follow) return follow();
    read_to_the_end();
    return end();
  }

 private:
  void read_to_the_end() {
    constexpr std::uint64_t kBetweenUpdates = 1024;
    while (const std::optional<Entry> entry = source_.next()) {
      const std::vector<Event> events = timeline_.take(*entry);
      note(events);
      exports_.take(*entry, events);
      if (bar_ && source_.records() % kBetweenUpdates == 0)
        bar_->update(static_cast<double>(source_.offset()) / static_cast<double>(source_.file_size() + 1));
    }
  }

  void note(std::span<const Event> events) {
    lacks_.note(events);
    if (!prints_) return;
    for (const Event& event : events) program::print() << to_line(event, timeline_.began()) << "\n";
  }

  int end() {
    if (source_.records() == 0) throw no_record_in(options_.journal);
    const std::vector<Event> events = timeline_.finish(source_.torn_end());
    note(events);
    if (const std::optional<std::string> record = prints_ ? host::safety_record_beside(options_.journal) : std::nullopt)
      program::print() << *record << "\n";
    bar_.reset();
    exports_.finish(events);
    program::print().flush();
    return lacks_.report();
  }

  int follow() {
    if (program::talk() != program::Talk::kQuiet)
      std::cerr << "earshot journal: follows " << host::printable(options_.journal.string()) << " until its mission ends; Ctrl-C ends it\n";
    steady_clock::time_point last_growth = steady_clock::now();
    for (std::uint64_t before = 0;; before = source_.records()) {
      read_to_the_end();
      if (!program::print().flush().good() && program::talk() != program::Talk::kQuiet) return program::kLost;
      if (timeline_.is_closed()) return end();
      if (program::stop_requested) return program::kStopped;
      if (source_.records() > before) last_growth = steady_clock::now();
      if (steady_clock::now() - last_growth > kLongSilence && !is_being_written(options_.journal)) return end();
      std::this_thread::sleep_for(kPollInterval);
      source_.resume_reading();
    }
  }

  const ViewOptions& options_;
  RecordSource source_;
  Exports exports_;
  Timeline timeline_;
  Lacks lacks_;
  bool prints_;
  std::optional<program::ProgressBar> bar_ = prints_ ? std::nullopt : std::optional<program::ProgressBar>(std::in_place, "journal");
};

/// What is read of a folder that holds several.
void report_others(const std::filesystem::path& journal) {
  const auto is_first_part = [](const host::JournalName& name) { return name.part == 1; };
  const auto journals = std::ranges::count_if(host::journals_beside(journal.parent_path() / host::kFirstJournal), is_first_part);
  if (journals > 1 && program::talk() != program::Talk::kQuiet)
    std::cerr << "earshot journal: reads " << host::printable(journal.string()) << ", the newest of " << journals
              << " journals in this folder; name another to read it\n";
}

/// A journal that is gone leaves the record that a vehicle is brought up by.
bool prints_record_alone(const ViewOptions& options) {
  std::error_code error;
  const bool asks_for_files = std::ranges::any_of(options.files, [](const auto& path) { return path.has_value(); });
  if (asks_for_files || std::filesystem::exists(options.journal, error)) return false;
  const std::optional<std::string> record = host::safety_record_beside(options.journal);
  if (record) program::print() << *record << "\n" << std::flush;
  return record.has_value();
}

}  // namespace

int view(const ViewOptions& asked) {
  ViewOptions options = asked;
  options.journal = host::newest_journal_in(asked.journal);  // flights at sea may share a folder, and whoever names it means the last one
  if (!options.follow && prints_record_alone(options)) {
    std::cerr << host::printable(options.journal.string()) << ": no such file; what is left is the safety record beside it\n";
    return program::kIncomplete;
  }
  if (!options.follow) {
    if (options.journal != asked.journal) report_others(options.journal);
    return Viewer(options).run();
  }
  program::stop_on_signals();
  const std::optional<std::filesystem::path> journal = wait_for_journal(asked.journal, options.wait);
  if (!journal) return program::kStopped;
  options.journal = *journal;
  return Viewer(options).run();
}

}  // namespace earshot::journal
