#include "firmware/host/memory/process_memory.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasShadowMemory = true;
#else
constexpr bool kHasShadowMemory = false;
#endif

/// What the stack is painted with, to see how far it has been used since.
constexpr unsigned char kPaint = 0xA5;

std::uintptr_t painted_from = 0;
std::size_t painted_bytes = 0;

/// Reads as much as fits, without the heap.
std::string_view read_into(std::span<char> buffer, const char* path) {
  const FileDescriptor file(::open(path, O_RDONLY | O_CLOEXEC));
  std::size_t size = 0;
  while (file.number() >= 0 && size < buffer.size()) {
    const ssize_t count = ::read(file.number(), buffer.data() + size, buffer.size() - size);
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  return {buffer.data(), size};
}

/// "VmLck:      8192 kB" -> bytes; 0 where there is no such line.
std::uint64_t bytes_of(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return 0;
  std::uint64_t kilobytes = 0;
  for (const char c : text.substr(at + key.size())) {
    if (c >= '0' && c <= '9') kilobytes = kilobytes * 10 + static_cast<std::uint64_t>(c - '0');
    if (c == '\n') break;
  }
  return kilobytes * 1024;
}

/// Writes to every page what stands there, as one indivisible step: another thread's write is not undone.
void touch(std::uintptr_t from, std::uintptr_t to) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (std::uintptr_t at = from; at < to; at += page) {
    const std::atomic_ref<unsigned char> byte(*reinterpret_cast<unsigned char*>(at));
    unsigned char value = byte.load();
    (void)byte.compare_exchange_strong(value, value);
  }
}

/// No more than half of what the system allows the main stack: the rest is in use, or stays free.
[[gnu::noinline]] std::size_t that_fits_stack(std::size_t bytes) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0) return bytes;
  return static_cast<std::size_t>(std::min<rlim_t>(bytes, limit.rlim_cur / 2));
}

[[gnu::noinline]] void paint_stack(std::size_t bytes) {
  auto* const low = static_cast<volatile unsigned char*>(__builtin_alloca(bytes));
  for (std::size_t i = 0; i < bytes; ++i) low[i] = kPaint;
  painted_from = reinterpret_cast<std::uintptr_t>(low);
  painted_bytes = bytes;
}

}  // namespace

void set_thread_stack(std::size_t bytes) {
  pthread_attr_t attributes;
  int error = ::pthread_attr_init(&attributes);
  if (error == 0) error = ::pthread_attr_setstacksize(&attributes, bytes);
  if (error == 0) error = ::pthread_setattr_default_np(&attributes);
  (void)::pthread_attr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::generic_category(), "a thread's stack of " + std::to_string(bytes) + " bytes");
}

void touch_stack(std::size_t bytes) {
  paint_stack(that_fits_stack(bytes));
}

std::size_t touched_stack_used() {
  const auto* const low = reinterpret_cast<const volatile unsigned char*>(painted_from);
  std::size_t untouched = 0;
  while (untouched < painted_bytes && low[untouched] == kPaint) ++untouched;
  return painted_bytes - untouched;
}

void touch_memory() {
  if (kHasShadowMemory) return;
  std::vector<char> buffer(std::size_t{1} << 20U);  // nothing may be allocated or freed while the list is gone through
  std::string_view rest = read_into(buffer, "/proc/self/maps");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    std::array<char, 128> line{};
    rest.copy(line.data(), std::min(end, line.size() - 1));
    rest.remove_prefix(end + 1);
    unsigned long from = 0;
    unsigned long to = 0;
    std::array<char, 5> rights{};
    if (std::sscanf(line.data(), "%lx-%lx %4s", &from, &to, rights.data()) == 3 && std::string_view(rights.data()) == "rw-p")
      touch(from, to);
  }
}

std::string lock_memory() {
  if (::mlockall(MCL_CURRENT) == 0) return {};
  const int error = errno;
  rlimit limit{};
  (void)::getrlimit(RLIMIT_MEMLOCK, &limit);
  const auto in_kb = [](std::uint64_t bytes) { return std::to_string(bytes / 1024) + " kB"; };
  return "memory is not locked (" + std::string(std::strerror(error)) + "): the system allows " + in_kb(limit.rlim_cur) + ", needed are " +
         in_kb(process_memory().address_space) +
         " (ulimit -l, or LimitMEMLOCK=infinity for systemd); under memory pressure a turn may be late";
}

ProcessMemory process_memory() {
  std::array<char, 8192> buffer{};
  ProcessMemory memory;
  const std::string_view status = read_into(buffer, "/proc/self/status");
  memory.address_space = bytes_of(status, "VmSize:");
  memory.locked = bytes_of(status, "VmLck:");
  memory.resident = bytes_of(status, "VmRSS:");
  memory.anonymous = bytes_of(status, "RssAnon:");
  // Counted page by page, where the kernel can; what stands in status may be some pages old.
  const std::string_view counted = read_into(buffer, "/proc/self/smaps_rollup");
  if (counted.empty()) return memory;
  memory.resident = bytes_of(counted, "Rss:");
  memory.anonymous = bytes_of(counted, "Anonymous:");
  return memory;
}

std::vector<std::string> thread_names() {
  std::vector<std::pair<int, std::string>> threads;
  std::error_code error;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::string name;
    std::getline(std::ifstream(task.path() / "comm"), name);
    threads.emplace_back(std::stoi(task.path().filename()), name);
  }
  std::ranges::sort(threads);
  std::vector<std::string> names;
  for (const auto& thread : threads) names.push_back(thread.second);
  return names;
}

}  // namespace earshot::host
