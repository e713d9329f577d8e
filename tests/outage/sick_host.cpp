// Loaded into a program by LD_PRELOAD: a computer on which something is wrong. While the file of EARSHOT_TEST_DISK_IS_SICK is there, the
// disk under journals and safety records (files that end with .lcmlog and .safety, but for those in a folder "memory") is sick in the way
// of EARSHOT_TEST_DISK ("slow", "full", "read-only"). The wall clock is EARSHOT_TEST_CLOCK_S seconds ahead; with EARSHOT_TEST_BOOT (the
// file of a boot id) the computer has started again twenty seconds ago. EARSHOT_TEST_THREADS is how many threads the program may have
// beside its first, EARSHOT_TEST_FILES how many open files.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace {

constexpr std::size_t kMostFiles = 1024;
constexpr int kMostThreads = 1'000'000;
std::array<bool, kMostFiles> is_on_disk{};  ///< and written
std::array<bool, kMostFiles> is_read{};     ///< a journal
std::array<off_t, kMostFiles> held{};       ///< bytes for which the disk has promised room

bool is_of_disk(std::string_view path) {
  return (path.ends_with(".lcmlog") || path.ends_with(".safety")) && path.find("/memory/") == std::string_view::npos;
}

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

int refuse(int error) {
  errno = error;
  return -1;
}

void take_a_second() {
  timespec second{.tv_sec = 1, .tv_nsec = 0};
  (void)::nanosleep(&second, nullptr);
}

/// How many of so many bytes at `offset` the disk takes; 0: errno says why.
std::size_t taken(int file, off_t offset, std::size_t size) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return errno = EROFS, 0;
  if (sickness == "slow") take_a_second();
  if (sickness != "full") return size;
  const off_t room = std::max(held[static_cast<std::size_t>(file)], ::lseek(file, 0, SEEK_END)) - offset;
  if (room <= 0) return errno = ENOSPC, 0;
  return std::min(size, static_cast<std::size_t>(room));
}

int brought(int file, long call) {
  const std::string_view sickness = sickness_of(file);
  if (sickness == "read-only") return refuse(EROFS);
  if (sickness == "slow") take_a_second();
  return static_cast<int>(::syscall(call, file));
}

FILE* opened(const char* path, const char* mode) {
  static const char* const boot = std::getenv("EARSHOT_TEST_BOOT");
  const bool is_boot_id = boot != nullptr && std::string_view(path) == "/proc/sys/kernel/random/boot_id";
  const int file = ::open(is_boot_id ? boot : path, *mode == 'r' ? O_RDONLY | O_CLOEXEC : O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  return file < 0 ? nullptr : ::fdopen(file, mode);
}

/// Before the program begins.
[[gnu::constructor]] void limit_files() {
  const char* const files = std::getenv("EARSHOT_TEST_FILES");
  if (files == nullptr) return;
  const auto most = static_cast<rlim_t>(std::atol(files));
  const rlimit limit{.rlim_cur = most, .rlim_max = most};
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
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
  if (is_to_write && (flags & O_CREAT) != 0 && present_sickness() == "full" && ::access(path, F_OK) != 0) return refuse(ENOSPC);
  const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  if (file >= 0 && static_cast<std::size_t>(file) < kMostFiles) {
    is_on_disk[static_cast<std::size_t>(file)] = is_to_write;
    is_read[static_cast<std::size_t>(file)] = !is_to_write && std::string_view(path).ends_with(".lcmlog");
  }
  return file;
}

ssize_t read(int file, void* bytes, std::size_t size) {
  static bool has_waited = false;
  const char* const reading_s = std::getenv("EARSHOT_TEST_READING_S");
  if (reading_s != nullptr && file >= 0 && static_cast<std::size_t>(file) < kMostFiles && is_read[static_cast<std::size_t>(file)] &&
      !std::exchange(has_waited, true))
    for (long s = std::atol(reading_s); s > 0; --s) take_a_second();
  return ::syscall(SYS_read, file, bytes, size);
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
  if (sickness == "full" && offset + size > std::max(held[static_cast<std::size_t>(file)], ::lseek(file, 0, SEEK_END)))
    return refuse(ENOSPC);
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

FILE* fopen(const char* path, const char* mode) {
  return opened(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  return opened(path, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* with) {
  static std::atomic<int> left{std::getenv("EARSHOT_TEST_THREADS") == nullptr ? kMostThreads
                                                                              : std::atoi(std::getenv("EARSHOT_TEST_THREADS"))};
  if (left-- <= 0) return EAGAIN;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const Create create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, work, with);
}

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int result = static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  if (const char* const ahead_s = std::getenv("EARSHOT_TEST_CLOCK_S"); ahead_s != nullptr && clock == CLOCK_REALTIME)
    now->tv_sec += std::atol(ahead_s);
  static thread_local time_t began = 0;
  if (clock == CLOCK_BOOTTIME && std::getenv("EARSHOT_TEST_BOOT") != nullptr) {
    if (began == 0) began = now->tv_sec - 20;
    now->tv_sec -= began;
  }
  return result;
}

}  // extern "C"
