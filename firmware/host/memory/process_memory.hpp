#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace earshot::host {

// The memory of this process, laid out before a flight so that nothing has to be fetched during it.

/// Gives every thread that is made from now on a stack of this size in bytes, which includes its guard page.
/// @throws std::system_error when the system takes no such stack
void set_thread_stack(std::size_t bytes);

/// Writes to the stack of the main thread, `bytes` below here (but no more than half of what the system allows it), so that its pages are
/// there; remembers where.
void touch_stack(std::size_t bytes);
/// How many of touch_stack's bytes were used since; all of them: more may have been.
[[nodiscard]] std::size_t touched_stack_used();

/// Writes what it holds already to every page of this process that can be written: heap, rings, data and all threads' stacks. Other threads
/// may run meanwhile, but must not unmap memory. In a sanitizer's build it does nothing: its shadow memory is larger than any computer.
void touch_memory();

/// Keeps what the process has now in physical memory.
/// @return empty; otherwise why the system does not let it, and what to do about it
[[nodiscard]] std::string lock_memory();

/// What the kernel says, in bytes.
struct ProcessMemory {
  std::uint64_t address_space = 0;  ///< everything mapped, there or not
  std::uint64_t resident = 0;       ///< in physical memory, shared libraries and program text among it
  std::uint64_t anonymous = 0;      ///< of that: heap, stacks, rings and what was written of data: only the process itself makes it grow
  std::uint64_t locked = 0;         ///< of the address space
};
/// Uses no heap. Zeros where the kernel does not say.
[[nodiscard]] ProcessMemory process_memory();

/// Of every thread of this process, in the order in which they were made.
[[nodiscard]] std::vector<std::string> thread_names();

}  // namespace earshot::host
