// Loaded into a program by LD_PRELOAD: while the file of EARSHOT_TEST_DISK_IS_SICK is there, the disk under its journals (files that end
// with .lcmlog) is sick in the way of EARSHOT_TEST_DISK: "slow", "full", "crammed" (full, and without room for the name of another file),
// "read-only". With EARSHOT_TEST_DISK_HAS_RECORD the safety records (.safety) are on it, too, but for those in a folder "memory": one that
// is full takes them all the same, for they are written in place.

#include <fcntl.h>
#include <sys/stat.h>
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
std::array<bool, kMostFiles> is_on_disk{};  ///< and written
std::array<off_t, kMostFiles> held{};       ///< bytes for which the disk has promised room

bool is_of_disk(std::string_view path) {
  static const bool has_record = std::getenv("EARSHOT_TEST_DISK_HAS_RECORD") != nullptr;
  return path.ends_with(".lcmlog") || (has_record && path.ends_with(".safety") && path.find("/memory/") == std::string_view::npos);
}

/// "" while it is well.
std::string_view present_sickness() {
  const char* const sickness = std::getenv("EARSHOT_TEST_DISK");
  const char* const flag = std::getenv("EARSHOT_TEST_DISK_IS_SICK");
  if (sickness == nullptr || flag == nullptr || ::access(flag, F_OK) != 0) return {};
  return sickness;
}

std::string_view sickness_of(int file) {
  const bool is_known = file >= 0 && static_cast<std::size_t>(file) < kMostFiles && is_on_disk[static_cast<std::size_t>(file)];
  return is_known ? present_sickness() : std::string_view{};
}

bool is_full(std::string_view sickness) {
  return sickness == "full" || sickness == "crammed";
}

int refuse(int error) {
  errno = error;
  return -1;
}

void take_a_second() {
  timespec second{.tv_sec = 1, .tv_nsec = 0};
  (void)::nanosleep(&second, nullptr);
}

/// Bytes that the disk holds or has promised: these are there, however full it is.
off_t room_of(int file) {
  struct stat status {};
  (void)::fstat(file, &status);
  return std::max(held[static_cast<std::size_t>(file)], status.st_size);
}

/// How many of so many bytes at `offset` the disk takes; 0: errno says why.
std::size_t taken(int file, off_t offset, std::size_t size) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return errno = EROFS, 0;
  if (sickness == "slow") take_a_second();
  if (!is_full(sickness)) return size;
  const off_t room = room_of(file) - offset;
  if (room <= 0) return errno = ENOSPC, 0;
  return std::min(size, static_cast<std::size_t>(room));
}

int brought(int file, long call) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "slow") take_a_second();
  return static_cast<int>(::syscall(call, file));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  const bool is_to_write = is_of_disk(path) && (flags & O_ACCMODE) != O_RDONLY;
  if (is_to_write && present_sickness() == "read-only") return refuse(EROFS);
  if (is_to_write && (flags & O_CREAT) != 0 && present_sickness() == "crammed" && ::access(path, F_OK) != 0) return refuse(ENOSPC);
  const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file >= 0 && static_cast<std::size_t>(file) < kMostFiles) {
    is_on_disk[static_cast<std::size_t>(file)] = is_to_write;
    held[static_cast<std::size_t>(file)] = 0;
  }
  return file;
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  if (sickness_of(file).empty()) return ::syscall(SYS_write, file, bytes, size);
  const std::size_t most = taken(file, ::lseek(file, 0, SEEK_CUR), size);
  return most == 0 ? -1 : ::syscall(SYS_write, file, bytes, most);
}

ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  if (sickness_of(file).empty()) return ::syscall(SYS_pwrite64, file, bytes, size, offset);
  const std::size_t most = taken(file, offset, size);
  return most == 0 ? -1 : ::syscall(SYS_pwrite64, file, bytes, most, offset);
}

int fallocate(int file, int mode, off_t offset, off_t size) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (is_full(sickness) && offset + size > room_of(file)) return refuse(ENOSPC);
  const int result = static_cast<int>(::syscall(SYS_fallocate, file, mode, offset, size));
  if (result == 0 && file >= 0 && static_cast<std::size_t>(file) < kMostFiles)
    held[static_cast<std::size_t>(file)] = std::max(held[static_cast<std::size_t>(file)], offset + size);
  return result;
}

int fdatasync(int file) {
  return brought(file, SYS_fdatasync);
}

int fsync(int file) {
  return brought(file, SYS_fsync);
}

int ftruncate(int file, off_t size) noexcept {
  if (sickness_of(file) == "read-only") return refuse(EROFS);
  return static_cast<int>(::syscall(SYS_ftruncate, file, size));
}

}  // extern "C"
