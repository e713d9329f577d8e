#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/memory/process_memory.hpp"

namespace earshot::board {

/// Bytes of the main thread's stack that are there before the first turn; a mission uses some 20 kB of it. Full: the system adds pages.
inline constexpr std::size_t kMainStackBytes = 262'144;
/// Bytes of every other thread's stack (the journal's writer, the event log's). Full: the process ends.
inline constexpr std::size_t kThreadStackBytes = 262'144;

/// Lays out the memory of a flight: the main thread's stack and every page that the process may write are written once, and locked where
/// the system allows it. After all has been opened and made; before it, every thread's stack is given its size (host::set_thread_stack).
/// @return empty, or why memory is not locked
[[nodiscard]] std::string settle_memory();

/// Shows that after arming no thread of this process asks for memory: the heap's functions are counted by a trap
/// (host/memory/heap_trap.hpp); what could go past it, a mapping made within the C library or by a bare system call, shows as a growth of
/// the address space or of the memory in use. The kernel's own memory (socket buffers, the page cache) is not the process's and is not
/// counted.
class MemoryProof {
 public:
  /// From here on. After settle_memory().
  void arm();
  /// Up to here, before anything is closed.
  /// @param flown  by the loop meanwhile
  void disarm(const LoopResult& flown);

  /// No thread used the heap, and neither the address space nor the memory in use has grown.
  [[nodiscard]] bool holds() const;
  /// "0 allocations in 3 threads over 69 turns: 4 in STANDBY, 60 in SEARCH, 5 in ABORT", or who allocated what.
  [[nodiscard]] std::string verdict() const;
  /// What is not proven, because it was not flown; empty when a search was.
  [[nodiscard]] std::string remark() const;
  /// What the memory is spent on, a line each.
  [[nodiscard]] std::string bill(const PortSet& ports) const;

 private:
  [[nodiscard]] bool has_grown() const;

  host::ProcessMemory before_;
  host::ProcessMemory after_;
  std::vector<host::HeapUse> uses_;
  std::vector<std::string> threads_;
  std::size_t main_stack_used_ = 0;
  LoopResult flown_;
};

}  // namespace earshot::board
