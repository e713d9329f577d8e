#include "firmware/desk/journal_view/followed_journal.hpp"

#include <iostream>
#include <string>
#include <system_error>
#include <thread>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {
namespace {

namespace fs = std::filesystem;

/// Nobody looks at the mark of an empty file: its writer may be about to set it, and must not find it taken.
bool is_empty_or_missing(const fs::path& journal) {
  std::error_code error;
  if (!fs::exists(journal, error)) return true;
  return fs::is_regular_file(journal, error) && fs::file_size(journal, error) == 0;
}

/// Of simulated flights alone a new one takes an old one's place.
bool is_of_simulation(const fs::path& journal) {
  host::JournalRecord first;
  return host::JournalReader(journal).next(first) && !host::is_dated(first.time);
}

std::optional<fs::path> flight_under_way_beside(const fs::path& journal) {
  const fs::path folder = journal.has_parent_path() ? journal.parent_path() : fs::path(".");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with("unfinished-flight")) continue;
    const fs::path flown = entry.path() / journal.filename();
    if (!is_empty_or_missing(flown) && is_being_written(flown)) return flown;
  }
  return std::nullopt;
}

}  // namespace

bool is_being_written(const fs::path& journal) try {
  host::require_not_being_written(journal);
  return false;
} catch (const host::FolderInUse&) {
  return true;
}

std::optional<fs::path> journal_under_way(const fs::path& folder_or_journal) {
  const fs::path journal = host::newest_journal_in(folder_or_journal);
  if (std::optional<fs::path> flown = flight_under_way_beside(journal)) return flown;
  if (is_empty_or_missing(journal)) return std::nullopt;
  if (is_being_written(journal) || !is_of_simulation(journal)) return journal;
  return std::nullopt;
}

std::optional<fs::path> wait_for_journal(const fs::path& folder_or_journal, std::chrono::seconds most) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPollInterval{100};
  const auto began = steady_clock::now();
  for (bool is_printed = program::talk() == program::Talk::kQuiet;;) {
    if (std::optional<fs::path> found = journal_under_way(folder_or_journal)) return found;
    if (program::stop_requested) return std::nullopt;
    const fs::path journal = host::newest_journal_in(folder_or_journal);
    const bool is_there = fs::exists(journal);
    if (steady_clock::now() - began >= most)
      throw host::BadInput(host::printable(journal.string()) +
                           (is_there ? ": is of a flight that is over, and no other began there; without --follow it is read"
                                     : ": no such file; no mission began there"));
    if (!is_printed) {
      std::cerr << "earshot journal: waiting for a mission that writes " << host::printable(journal.string())
                << (is_there ? " anew (what stands there is of a flight that is over), " : ", ") << most.count() << " s at most\n";
      is_printed = true;
    }
    std::this_thread::sleep_for(kPollInterval);
  }
}

}  // namespace earshot::journal
