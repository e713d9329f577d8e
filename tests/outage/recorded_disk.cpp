#include "tests/outage/recorded_disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace earshot::outage {
namespace {

/// A file that this process has open.
struct Open {
  std::string name;  ///< empty: the folder itself
  std::uint64_t offset = 0;
};

struct State {
  std::mutex mutex;
  std::string folder;  ///< empty: nobody looks
  DiskMood mood;
  std::map<int, Open> open;
  std::map<std::string, std::uint64_t> held;  ///< bytes that each file has, or has been promised
  std::vector<DiskCall> calls;
};

State& state() {
  static State the_state;
  return the_state;
}

void note(DiskCall call) {
  call.when = SteadyClock::now();
  state().calls.push_back(std::move(call));
}

/// What path names in the folder that is looked at: "" for the folder itself.
std::optional<std::string> name_in_folder(const char* path) {
  const std::filesystem::path full = std::filesystem::path(path).lexically_normal();
  const std::string& folder = state().folder;
  if (folder.empty()) return std::nullopt;
  if (full == folder) return std::string();
  return full.parent_path() == folder ? std::optional(full.filename().string()) : std::nullopt;
}

Open* open_file(int file) {
  const auto found = state().open.find(file);
  return found == state().open.end() ? nullptr : &found->second;
}

/// Waits as long as the disk takes, without the lock: others go on meanwhile.
void wait_for_disk(int file) {
  std::chrono::microseconds delay{0};
  {
    const std::lock_guard lock(state().mutex);
    if (open_file(file) != nullptr) delay = state().mood.delay();
  }
  if (delay.count() > 0) std::this_thread::sleep_for(delay);
}

/// Room for a file that is to hold so many bytes. False: the disk is full.
bool take_room(const std::string& name, std::uint64_t size) {
  std::uint64_t others = 0;
  for (const auto& [other, held] : state().held) others += other == name ? 0 : held;
  std::uint64_t& held = state().held[name];
  if (size > held && others + size > state().mood.room_bytes) return false;
  held = std::max(held, size);
  return true;
}

int refuse(int error) {
  errno = error;
  return -1;
}

}  // namespace

RecordedDisk::RecordedDisk(const std::filesystem::path& folder) {
  const std::lock_guard lock(state().mutex);
  state().folder = std::filesystem::canonical(folder).string();
}

RecordedDisk::~RecordedDisk() {
  const std::lock_guard lock(state().mutex);
  state().folder.clear();
  state().open.clear();
  state().held.clear();
  state().calls.clear();
  state().mood = {};
}

void RecordedDisk::be(DiskMood mood) {
  const std::lock_guard lock(state().mutex);
  state().mood = std::move(mood);
}

std::vector<DiskCall> RecordedDisk::calls() const {
  const std::lock_guard lock(state().mutex);
  return state().calls;
}

}  // namespace earshot::outage

// The kernel's calls, as the program that is looked at makes them.
extern "C" {

using namespace earshot::outage;
using Kind = DiskCall::Kind;

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  const std::lock_guard lock(state().mutex);
  const std::optional<std::string> name = name_in_folder(path);
  const bool was_there = ::access(path, F_OK) == 0;
  const int file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file < 0 || !name) return file;
  state().open[file] = {.name = *name};
  if (!name->empty() && !was_there) note({.kind = Kind::kCreate, .file = *name});
  if (!name->empty() && was_there && (flags & O_TRUNC) != 0) note({.kind = Kind::kCut, .file = *name});
  return file;
}

int close(int file) {
  {
    const std::lock_guard lock(state().mutex);
    state().open.erase(file);
  }
  return static_cast<int>(syscall(SYS_close, file));
}

ssize_t write(int file, const void* bytes, size_t size) {
  wait_for_disk(file);
  const std::lock_guard lock(state().mutex);
  Open* open = open_file(file);
  if (open == nullptr) return syscall(SYS_write, file, bytes, size);
  size = std::min(size, state().mood.most_at_once);
  if (!take_room(open->name, open->offset + size)) return refuse(ENOSPC);
  const ssize_t count = syscall(SYS_write, file, bytes, size);
  if (count > 0) {
    const auto* begin = static_cast<const std::uint8_t*>(bytes);
    note({.kind = Kind::kWrite, .file = open->name, .offset = open->offset, .bytes = {begin, begin + count}});
    open->offset += static_cast<std::uint64_t>(count);
  }
  return count;
}

off_t lseek(int file, off_t offset, int whence) noexcept {
  const std::lock_guard lock(state().mutex);
  const off_t at = syscall(SYS_lseek, file, offset, whence);
  if (Open* open = open_file(file); open != nullptr && at >= 0) open->offset = static_cast<std::uint64_t>(at);
  return at;
}

int ftruncate(int file, off_t size) noexcept {
  const std::lock_guard lock(state().mutex);
  const int result = static_cast<int>(syscall(SYS_ftruncate, file, size));
  if (Open* open = open_file(file); open != nullptr && result == 0) {
    state().held[open->name] = static_cast<std::uint64_t>(size);
    note({.kind = Kind::kCut, .file = open->name, .offset = static_cast<std::uint64_t>(size)});
  }
  return result;
}

int fallocate(int file, int mode, off_t offset, off_t size) {
  wait_for_disk(file);
  const std::lock_guard lock(state().mutex);
  if (Open* open = open_file(file); open != nullptr && !take_room(open->name, static_cast<std::uint64_t>(offset + size)))
    return refuse(ENOSPC);
  return static_cast<int>(syscall(SYS_fallocate, file, mode, offset, size));
}

int fsync(int file) {
  wait_for_disk(file);
  const std::lock_guard lock(state().mutex);
  if (Open* open = open_file(file); open != nullptr)
    note({.kind = open->name.empty() ? Kind::kKeepEntries : Kind::kBringToDisk, .file = open->name});
  return 0;
}

int fdatasync(int file) {
  return fsync(file);
}

int unlink(const char* path) noexcept {
  const std::lock_guard lock(state().mutex);
  const int result = static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
  if (const std::optional<std::string> name = name_in_folder(path); name && result == 0) {
    state().held.erase(*name);
    note({.kind = Kind::kRemove, .file = *name});
  }
  return result;
}

}  // extern "C"
