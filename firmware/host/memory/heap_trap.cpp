// mmap and mmap64 are two functions here, not two names of one.
#undef _FILE_OFFSET_BITS
#undef _TIME_BITS
#include "firmware/host/memory/heap_trap.hpp"

#include <execinfo.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <memory>
#include <type_traits>

namespace earshot::host {
namespace {

/// Threads that are told apart; full: the rest is counted together.
constexpr std::size_t kMostThreads = 64;

enum class Call : std::uint8_t { kAllocation, kRelease, kMapping };

/// A row is written by its own thread alone, but for the last, of which only the atomic numbers are used.
struct Row {
  std::atomic<std::uint64_t> allocations, releases, mappings, bytes;
  HeapUse first;
};

std::atomic<bool> armed{false};
std::atomic<std::uint32_t> arming{0};  ///< how often the trap was armed: a thread's row is of one arming
std::atomic<std::size_t> rows_taken{0};
std::array<Row, kMostThreads + 1> rows;
std::array<HeapUse, kMostThreads + 1> uses;

thread_local Row* row = nullptr;
thread_local std::uint32_t row_is_of = 0;
thread_local bool is_noting = false;

void take_row() {
  const std::size_t number = std::min(rows_taken.fetch_add(1), kMostThreads);
  row = &rows[number];
  row_is_of = arming;
  if (number == kMostThreads) return;
  row->first.thread = ::gettid();
  (void)::pthread_getname_np(::pthread_self(), row->first.name.data(), row->first.name.size());
  row->first.first_count = static_cast<std::size_t>(::backtrace(row->first.first.data(), static_cast<int>(row->first.first.size())));
}

[[maybe_unused]] void note(Call call, std::size_t size) {
  if (!armed.load(std::memory_order_relaxed) || is_noting) return;
  is_noting = true;
  if (row == nullptr || row_is_of != arming) take_row();
  std::atomic<std::uint64_t>& count =
      call == Call::kAllocation ? row->allocations : (call == Call::kRelease ? row->releases : row->mappings);
  ++count;
  row->bytes += size;
  is_noting = false;
}

}  // namespace

void arm_heap_trap() {
  armed = false;
  std::array<void*, 2> frames{};
  (void)::backtrace(frames.data(), static_cast<int>(frames.size()));  // the first call loads a library
  for (Row& r : rows) {
    r.allocations = r.releases = r.mappings = r.bytes = 0;
    r.first = {};
  }
  rows_taken = 0;
  ++arming;
  armed = kHeapTrapCounts;
}

void disarm_heap_trap() {
  armed = false;
}

std::span<const HeapUse> heap_uses() {
  const std::size_t count = std::min(rows_taken.load(), rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    uses[i] = rows[i].first;
    uses[i].allocations = rows[i].allocations;
    uses[i].releases = rows[i].releases;
    uses[i].mappings = rows[i].mappings;
    uses[i].bytes = rows[i].bytes;
  }
  return std::span(uses).first(count);
}

std::string to_string(const HeapUse& use) {
  std::string text = use.thread == 0 ? "further threads" : "thread " + std::to_string(use.thread) + " (" + use.name.data() + ")";
  text += ": " + std::to_string(use.allocations) + " allocations, " + std::to_string(use.releases) + " releases, " +
          std::to_string(use.mappings) + " mappings, " + std::to_string(use.bytes) + " bytes";
  const std::unique_ptr<char*, decltype(&std::free)> frames(::backtrace_symbols(use.first.data(), static_cast<int>(use.first_count)),
                                                            &std::free);
  if (use.first_count > 0) text += "; the first, from within:";
  for (std::size_t i = 0; frames != nullptr && i < use.first_count; ++i) text += "\n    " + std::string(frames.get()[i]);
  return text;
}

}  // namespace earshot::host

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
using earshot::host::Call;
using earshot::host::note;

// The C library's own, by the names under which it keeps them for whoever replaces the others. operator new and delete come through here
// too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_valloc(std::size_t size);
void* __libc_pvalloc(std::size_t size);
void __libc_free(void* memory);
void* __sbrk(std::intptr_t increment);

void* malloc(std::size_t size) noexcept {
  note(Call::kAllocation, size);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  note(Call::kAllocation, count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  note(Call::kAllocation, size);
  return __libc_realloc(old, size);
}
void* reallocarray(void* old, std::size_t count, std::size_t size) noexcept {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes)) {
    errno = ENOMEM;
    return nullptr;
  }
  return realloc(old, bytes);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  note(Call::kAllocation, size);
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  if (alignment % sizeof(void*) != 0 || alignment == 0 || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* const made = memalign(alignment, size);
  if (made == nullptr) return ENOMEM;
  *memory = made;
  return 0;
}
void* valloc(std::size_t size) noexcept {
  note(Call::kAllocation, size);
  return __libc_valloc(size);
}
void* pvalloc(std::size_t size) noexcept {
  note(Call::kAllocation, size);
  return __libc_pvalloc(size);
}
void free(void* memory) noexcept {
  if (memory != nullptr) note(Call::kRelease, 0);
  __libc_free(memory);
}

#ifdef SYS_mmap2  // of 32-bit machines: it takes its offset in units of 4096 bytes
void* mmap64(void* at, std::size_t size, int protection, int flags, int file, off64_t offset) noexcept {
  constexpr off64_t kUnit = 4096;
  note(Call::kMapping, size);
  if (offset % kUnit != 0 || offset < 0 || offset / kUnit > std::numeric_limits<unsigned long>::max()) {
    errno = EINVAL;
    return MAP_FAILED;
  }
  return reinterpret_cast<void*>(::syscall(SYS_mmap2, at, size, protection, flags, file, static_cast<unsigned long>(offset / kUnit)));
}
#else
static_assert(sizeof(off64_t) == sizeof(long), "the system call takes its offset in bytes");
void* mmap64(void* at, std::size_t size, int protection, int flags, int file, off64_t offset) noexcept {
  note(Call::kMapping, size);
  return reinterpret_cast<void*>(::syscall(SYS_mmap, at, size, protection, flags, file, offset));
}
#endif
void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  // 32 bits are counted to 4 GB, as the C library counts them.
  return mmap64(at, size, protection, flags, file, static_cast<off64_t>(static_cast<std::make_unsigned_t<off_t>>(offset)));
}
void* sbrk(std::intptr_t increment) noexcept {
  if (increment != 0) note(Call::kMapping, increment > 0 ? static_cast<std::size_t>(increment) : 0);
  return __sbrk(increment);
}
}
#endif
