#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace earshot::host {

// A program that is linked with this and names one of the functions below has the heap's own functions replaced by ones that count while
// the trap is armed: malloc, calloc, realloc, reallocarray, aligned_alloc, posix_memalign, memalign, valloc, pvalloc, free, and with them
// every form of new and delete and what the C library allocates for itself; mmap and sbrk beside them. Asleep, it costs one relaxed load a
// call.

/// What one thread did with the heap while the trap was armed.
struct HeapUse {
  int thread = 0;                 ///< the kernel's number of it; 0: all those together for which there was no room
  std::array<char, 16> name{};    ///< of the thread, ending with a zero
  std::uint64_t allocations = 0;  ///< calls, whatever their size
  std::uint64_t releases = 0;     ///< free() of something
  std::uint64_t mappings = 0;     ///< mmap, sbrk with an increment
  std::uint64_t bytes = 0;        ///< of allocations and mappings
  std::array<void*, 24> first{};  ///< return addresses of the first call, innermost first
  std::size_t first_count = 0;
};

/// False in a build for a sanitizer that brings a heap of its own: nothing is counted there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHeapTrapCounts = false;
#else
inline constexpr bool kHeapTrapCounts = true;
#endif

/// From now on every thread's calls are counted, from zero. The trap itself uses no heap while it is armed.
void arm_heap_trap();
void disarm_heap_trap();
/// Of every thread that was caught since the trap was armed last; none: nothing was. After disarm_heap_trap().
[[nodiscard]] std::span<const HeapUse> heap_uses();
/// For a person, a line and the addresses of its first call in the form that addr2line takes.
[[nodiscard]] std::string to_string(const HeapUse& use);

}  // namespace earshot::host
