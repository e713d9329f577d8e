#pragma once

#include <filesystem>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/memory_proof.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/core/status.hpp"
#include "firmware/host/journal/journal.hpp"

namespace earshot::board {

// What earshotd says on standard error once its mission has ended, and the exit status that follows of each part of it.

/// How the search ended. @param journal  the file that it says to keep; empty: there is none
[[nodiscard]] int report(const LoopResult& result, const Clock& clock, const PortSet& ports, const std::filesystem::path& journal);

/// Whether memory was asked for, and what it is spent on.
[[nodiscard]] int report(const MemoryProof& proof, const PortSet& ports);

/// Whether the journal is whole, which were deleted for it, and at sea what a power cut could have cost.
/// @param closed  what close() returned   @param wanted  after which the journals of the folder are named
[[nodiscard]] int report(const host::Journal& journal, Status closed, const std::filesystem::path& wanted, bool is_at_sea);

}  // namespace earshot::board
