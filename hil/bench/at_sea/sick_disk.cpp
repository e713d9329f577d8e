// Loaded into a program by LD_PRELOAD: the disk under its journals (files that end with .lcmlog) is sick in the way of EARSHOT_TEST_DISK
// ("slow", "full", "read-only") while the file of EARSHOT_TEST_DISK_IS_SICK is there. With EARSHOT_TEST_DISK_HAS_RECORD the safety record
// beside them (journal.safety) is on it, too: one that is full takes it all the same, for it is written in place.

#include <fcntl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace {

constexpr std::size_t kMostFiles = 1024;
std::array<bool, kMostFiles> is_journal{};
std::array<bool, kMostFiles> is_record{};
std::array<off_t, kMostFiles> held{};  ///< bytes for which the disk has promised room

bool is_among(const std::array<bool, kMostFiles>& files, int file) {
  return file >= 0 && static_cast<std::size_t>(file) < kMostFiles && files[static_cast<std::size_t>(file)];
}

bool is_of_journal(int file) {
  return is_among(is_journal, file);
}

/// "" while it is well.
std::string_view present_sickness() {
  const char* const sickness = std::getenv("EARSHOT_TEST_DISK");
  const char* const flag = std::getenv("EARSHOT_TEST_DISK_IS_SICK");
  if (sickness == nullptr || flag == nullptr || ::access(flag, F_OK) != 0) return {};
  return sickness;
}

std::string_view sickness_of(int file) {
  return is_of_journal(file) ? present_sickness() : std::string_view{};
}

bool has_record() {
  return std::getenv("EARSHOT_TEST_DISK_HAS_RECORD") != nullptr;
}

std::string_view sickness_of_record(int file) {
  return is_among(is_record, file) ? present_sickness() : std::string_view{};
}

int refuse(int error) {
  errno = error;
  return -1;
}

void take_a_second() {
  timespec second{.tv_sec = 1, .tv_nsec = 0};
  (void)::nanosleep(&second, nullptr);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  const std::string_view name = path;
  const bool is_of_record = has_record() && name.ends_with("/journal.safety") && (flags & O_ACCMODE) != O_RDONLY;
  const bool is_to_write = is_of_record || (name.ends_with(".lcmlog") && (flags & O_ACCMODE) != O_RDONLY);
  if (is_to_write && present_sickness() == "read-only") return refuse(EROFS);
  const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file >= 0 && static_cast<std::size_t>(file) < kMostFiles) {
    is_journal[static_cast<std::size_t>(file)] = name.ends_with(".lcmlog") && (flags & O_ACCMODE) == O_WRONLY;
    is_record[static_cast<std::size_t>(file)] = is_of_record;
  }
  return file;
}

ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  const std::string_view sickness = sickness_of_record(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "slow") take_a_second();
  return ::syscall(SYS_pwrite64, file, bytes, size, offset);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "slow") take_a_second();
  if (sickness == "full") {
    const off_t room = held[static_cast<std::size_t>(file)] - ::lseek(file, 0, SEEK_CUR);
    if (room <= 0) return refuse(ENOSPC);
    size = std::min(size, static_cast<std::size_t>(room));
  }
  return ::syscall(SYS_write, file, bytes, size);
}

int fallocate(int file, int mode, off_t offset, off_t size) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "full") return refuse(ENOSPC);
  const int result = static_cast<int>(::syscall(SYS_fallocate, file, mode, offset, size));
  if (result == 0 && is_of_journal(file)) {
    off_t& most = held[static_cast<std::size_t>(file)];
    most = std::max(most, offset + size);
  }
  return result;
}

int fdatasync(int file) {
  const std::string_view sickness = is_among(is_record, file) ? sickness_of_record(file) : sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "slow") take_a_second();
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

int ftruncate(int file, off_t size) noexcept {
  if (sickness_of(file) == "read-only") return refuse(EROFS);
  return static_cast<int>(::syscall(SYS_ftruncate, file, size));
}

}  // extern "C"
