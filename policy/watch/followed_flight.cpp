#include "policy/watch/followed_flight.hpp"

#include <sys/stat.h>

#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "firmware/desk/journal_view/followed_journal.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/program/talk.hpp"
#include "policy/report/document/flight_reading.hpp"

namespace earshot::watch {
namespace {

namespace fs = std::filesystem;

/// A file system that cannot mark a file as being written has nobody writing it: a program that flies writes a record a second.
constexpr std::chrono::seconds kLongSilence{3};
constexpr std::chrono::seconds kBetweenSearches{1};
/// At a time: a browser that waits for a long journal sees it grow.
constexpr std::chrono::milliseconds kMostTime{100};

std::string name_of(const fs::path& folder_or_journal) {
  const fs::path whole = fs::absolute(folder_or_journal).lexically_normal();
  return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
}

/// A simulator leaves its files at the end.
report::FlightSurroundings under_way(const fs::path& asked, const fs::path& journal) {
  return {.name = name_of(asked), .journal = journal, .files = {}, .recording = {}};
}

}  // namespace

FollowedFlight::FollowedFlight(fs::path folder_or_journal, std::optional<std::chrono::seconds> most_wait)
    : asked_(std::move(folder_or_journal)), flight_(std::make_unique<report::GrowingFlight>(under_way(asked_, {}))) {
  if (const std::optional<fs::path> journal = journal::journal_under_way(asked_)) {
    follow(under_way(asked_, *journal));
    return;
  }
  if (most_wait) {
    deadline_ = Clock::now() + *most_wait;
    before_ = id_of(host::newest_journal_in(asked_));
    return;
  }
  if (const fs::path newest = host::newest_journal_in(asked_); !fs::exists(newest))
    throw host::BadInput(newest.string() + ": no such file (--wait 60 waits for a mission that begins there)");
  follow(report::surroundings_of(asked_));
  has_files_ = true;
}

FollowedFlight::FileId FollowedFlight::id_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  return {.device = status.st_dev, .number = status.st_ino};
}

void FollowedFlight::follow(report::FlightSurroundings surroundings) {
  journal_ = surroundings.journal;
  id_ = id_of(journal_);
  source_ = std::make_unique<journal::RecordSource>(journal_, host::Accepts::kBusLogs);
  flight_ = std::make_unique<report::GrowingFlight>(std::move(surroundings));
  is_at_end_ = false;
  has_ended_ = false;
  has_files_ = false;
  last_growth_ = Clock::now();
}

bool FollowedFlight::take_entries() {
  if (is_at_end_) source_->resume_reading();
  is_at_end_ = false;
  bool has_taken = false;
  for (const auto most = Clock::now() + kMostTime; !is_at_end_ && Clock::now() < most;) {
    const std::optional<journal::Entry> entry = source_->next();
    is_at_end_ = !entry;
    if (!entry) break;
    add(*entry);
    has_taken = true;
  }
  return has_taken;
}

bool FollowedFlight::is_left() const {
  const bool may_be_left = flight_->is_over() || Clock::now() - last_growth_ > kLongSilence || source_->records() == 0;
  return may_be_left && !journal::is_being_written(journal_);
}

std::optional<fs::path> FollowedFlight::next_journal() const {
  std::optional<fs::path> found = journal::journal_under_way(asked_);
  if (source_) return found && id_of(*found) == id_ ? std::nullopt : found;
  // A simulated flight may begin and end between two searches.
  if (const fs::path newest = host::newest_journal_in(asked_); !found && fs::exists(newest) && id_of(newest) != before_) found = newest;
  return found;
}

bool FollowedFlight::take_files() {
  if (has_files_ || id_of(report::journal_of_flight(asked_)) != id_) return false;
  report::FlightSurroundings surroundings = report::surroundings_of(asked_);
  if (surroundings.files.summary.is_null()) return false;
  has_files_ = true;
  flight_ = report::read_to_its_end(std::move(surroundings));
  return true;
}

Change FollowedFlight::take() {
  return source_ && !has_ended_ ? take_more() : search();
}

Change FollowedFlight::take_more() {
  if (take_entries()) {
    last_growth_ = Clock::now();
    return Change::kMore;
  }
  if (!is_left()) return Change::kNone;
  if (take_entries()) return Change::kMore;  // what came before its writer left
  if (source_->records() == 0) throw host::BadInput(journal_.string() + ": not a journal: no record in it");
  has_ended_ = true;
  flight_->end(*source_);
  return Change::kMore;
}

Change FollowedFlight::search() {
  if (Clock::now() < next_search_) return Change::kNone;
  next_search_ = Clock::now() + kBetweenSearches;
  try {
    if (const std::optional<fs::path> next = next_journal()) {
      follow(under_way(asked_, *next));
      return Change::kOther;
    }
    if (source_ && take_files()) return Change::kOther;
  } catch (const host::BadInput& e) {
    program::detail() << "earshot watch: " << host::printable_lines(e.what()) << "\n";  // a file that moves, or moved
  }
  if (!source_ && Clock::now() > *deadline_)
    throw host::BadInput(host::newest_journal_in(asked_).string() + ": no mission began there while it was waited for");
  return Change::kNone;
}

void FollowedFlight::wait(std::chrono::milliseconds most) {
  std::this_thread::sleep_for(most);
}

}  // namespace earshot::watch
