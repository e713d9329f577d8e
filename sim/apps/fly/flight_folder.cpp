#include "sim/apps/fly/flight_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/core/time.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_reader.hpp"

namespace earshot::fly {
namespace {

namespace fs = std::filesystem;

/// All that a flight leaves, in the order in which it moves up; what was there goes in the opposite order. The summary is thus the first to
/// go and the last to come: nothing without it passes for a whole flight.
constexpr std::array<const char*, 9> kFiles{"journal.lcmlog", "journal.policy",  "journal.tables", "track.csv",   "snr.csv",
                                            "hearing.csv",    "spectrogram.csv", "report.html",    "summary.json"};

fs::path topmost_missing(fs::path folder) {
  fs::path missing;
  for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) missing = folder;
  return missing;
}

bool is_free(const fs::path& path) {
  return !fs::exists(path) || (fs::is_directory(path) && fs::is_empty(path));
}

fs::path free_name(const fs::path& path) {
  fs::path name = path;
  for (int number = 2; !is_free(name); ++number) name = path.string() + "-" + std::to_string(number);
  return name;
}

void bring_to_disk(const fs::path& path) {
  const host::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0 || ::fsync(file.number()) != 0) throw std::system_error(errno, std::generic_category(), path.string());
}

/// A vehicle's journal of a mission at sea bears the same name as a flight's: its clock tells it from one. @throws host::BadInput
void require_not_from_sea(const fs::path& journal) {
  if (!fs::is_regular_file(journal)) return;
  constexpr Time kYear2000{946'684'800'000'000};  // no simulated flight lasts so long
  host::JournalRecord first;
  if (!host::JournalReader(journal).next(first) || first.time < kYear2000) return;
  throw host::BadInput(host::printable(journal.string()) +
                       ": is the journal of a mission at sea, which no flight replaces: choose another folder with --out");
}

/// Other folders within it are nobody's concern: out/seven may come before out. @throws host::BadInput naming a file that is no flight's
void require_for_flights(const fs::path& folder) {
  if (fs::exists(folder / kFiles.back())) return;  // an earlier flight's, whatever else lies there
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() || name.starts_with('.')) continue;
    throw host::BadInput(host::printable(folder.string()) + ": holds " + host::printable(name) +
                         ", and no earlier flight: choose another folder for this one with --out");
  }
}

/// @return bytes that a user may still write there; nothing where that cannot be known
std::optional<std::uintmax_t> room_in(const fs::path& folder) {
  std::error_code unknown;
  const fs::space_info space = fs::space(folder, unknown);
  return unknown ? std::nullopt : std::optional(space.available);
}

/// Less than the shortest flight takes: without it the programs of the flight would one after the other say what they miss.
/// @throws host::BadInput
void require_room(const fs::path& folder, const fs::path& on_disk_of) {
  constexpr std::uintmax_t kLeast = 1 << 20;
  const std::optional<std::uintmax_t> room = room_in(on_disk_of);
  if (room && *room < kLeast)
    throw host::BadInput(host::printable(folder.string()) + ": the disk is full: " + std::to_string(*room / 1024) +
                         " kB are left, and a flight takes some thousands: make room, or choose another folder with --out");
}

}  // namespace

std::string place_of_rest(const fs::path& unfinished) {
  constexpr std::uintmax_t kNextToNothing = 128 * 1024;  // of which the journal keeps half for orders
  const bool is_full = room_in(unfinished).value_or(kNextToNothing) < kNextToNothing;
  return "what there is of it is in " + host::printable(unfinished.string()) + (is_full ? ", and the disk is full" : "");
}

FlightFolder::FlightFolder(fs::path folder) : folder_(std::move(folder)), first_made_(topmost_missing(fs::absolute(folder_))) {
  require_room(folder_, first_made_.empty() ? folder_ : first_made_.parent_path());
  fs::create_directories(folder_);
  lock_ = host::lock_folder(folder_);
  host::require_not_being_written(folder_ / kFiles.front());
  require_not_from_sea(folder_ / kFiles.front());
  if (fs::exists(folder_ / "finished-flight")) move_up();
  require_for_flights(folder_);
  unfinished_ = free_name(folder_ / "unfinished-flight");
}

FlightFolder::~FlightFolder() {
  std::error_code not_empty;
  fs::remove(unfinished_, not_empty);
  if (first_made_.empty()) return;
  for (fs::path made = fs::absolute(folder_); fs::remove(made, not_empty) && made != first_made_;) made = made.parent_path();
}

void FlightFolder::keep() {
  host::require_not_being_written(folder_ / kFiles.front());
  for (const auto& file : fs::directory_iterator(unfinished_)) bring_to_disk(file.path());
  bring_to_disk(unfinished_);
  fs::rename(unfinished_, folder_ / "finished-flight");
  bring_to_disk(folder_);
  move_up();
}

void FlightFolder::move_up() {
  const fs::path finished = folder_ / "finished-flight";
  if (fs::exists(finished / kFiles.front())) {  // nothing has moved yet
    for (std::size_t i = kFiles.size(); i-- > 0;) fs::remove(folder_ / kFiles[i]);
  }
  for (const char* name : kFiles) {
    if (fs::exists(finished / name)) fs::rename(finished / name, folder_ / name);
  }
  fs::remove_all(finished);
  bring_to_disk(folder_);
}

void require_left_alone(const FlightPlan& plan, const fs::path& mission, const fs::path& recording, const fs::path& folder) {
  host::DistinctFiles files;
  files.read("--mission", mission);
  files.read("a file of --environment", plan.scenario.environment.files);
  if (!recording.empty()) files.read("--hear", recording);
  for (const char* name : kFiles) files.write("a file of --out", folder / name);
}

}  // namespace earshot::fly
