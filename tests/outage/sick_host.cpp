// Loaded into a program by LD_PRELOAD: a computer on which something is wrong. The wall clock is EARSHOT_TEST_CLOCK_S seconds ahead; with
// EARSHOT_TEST_BOOT (the file of a boot id) the computer has started again twenty seconds ago. EARSHOT_TEST_THREADS is how many threads the
// program may have beside its first, EARSHOT_TEST_FILES how many open files. The first journal that is read takes EARSHOT_TEST_READING_S
// seconds. Its disk: hil/bench/at_sea/sick_disk.cpp.

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
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

constexpr int kMostThreads = 1'000'000;

FILE* opened(const char* path, const char* mode) {
  static const char* const boot = std::getenv("EARSHOT_TEST_BOOT");
  const bool is_boot_id = boot != nullptr && std::string_view(path) == "/proc/sys/kernel/random/boot_id";
  const int file = ::open(is_boot_id ? boot : path, *mode == 'r' ? O_RDONLY | O_CLOEXEC : O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  return file < 0 ? nullptr : ::fdopen(file, mode);
}

/// Asks the heap for nothing: who reads may have to do without.
bool is_journal(int file) {
  constexpr std::string_view kFolder = "/proc/self/fd/";
  std::array<char, 32> name{};
  std::to_chars(std::ranges::copy(kFolder, name.begin()).out, name.end() - 1, file);
  std::array<char, 4096> path{};
  const ssize_t size = ::readlink(name.data(), path.data(), path.size());
  return size > 0 && std::string_view(path.data(), static_cast<std::size_t>(size)).ends_with(".lcmlog");
}

/// Before the program begins.
[[gnu::constructor]] void limit_files() {
  const char* const files = std::getenv("EARSHOT_TEST_FILES");
  if (files == nullptr) return;
  (void)::close_range(3, ~0U, 0);  // what a test's own starter left open does not count
  const auto most = static_cast<rlim_t>(std::atol(files));
  const rlimit limit{.rlim_cur = most, .rlim_max = most};
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

extern "C" {

ssize_t read(int file, void* bytes, std::size_t size) {
  static bool has_waited = false;
  const char* const reading_s = std::getenv("EARSHOT_TEST_READING_S");
  if (reading_s != nullptr && !has_waited && is_journal(file)) {
    has_waited = true;
    const timespec wait{.tv_sec = std::atol(reading_s), .tv_nsec = 0};
    (void)::nanosleep(&wait, nullptr);
  }
  return ::syscall(SYS_read, file, bytes, size);
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
