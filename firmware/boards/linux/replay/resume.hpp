#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/boards/linux/replay/playback.hpp"
#include "firmware/boards/linux/turn/turn_memory.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/journal/journal_file.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// A mission as it stood when the process that flew it ended, out of its journal.
struct Resumption {
  std::unique_ptr<runtime::Runtime> runtime;
  TurnMemory memory;
  runtime::Outputs last;                       ///< of the last turn
  std::uint32_t next_number = 0;               ///< of the journal's next record
  std::uint64_t kept_bytes = 0;                ///< of the journal, from its beginning
  std::uint64_t cut_bytes = 0;                 ///< behind them: a record that was never whole, or a turn that is made again
  std::vector<Playback::Unwritten> unwritten;  ///< what the last turn said and the process no longer wrote
};

/// From where a mission goes on.
enum class GoOnAfter {
  kLastInput,  ///< at sea: everything that was heard counts, an ABORT between two turns too
  kLastTurn,   ///< in lock-step: the simulator brings what came after it once more
};

/// Gives a fresh runtime everything that stands in the journal. Nothing: there is nothing to go on with, for it was ended in order, or its
/// process ended before the first turn.
/// @param flown  what is to be flown
/// A record that is missing in the last second of a journal at sea (kJournalBudget) was torn out by a power cut: the mission goes on from
/// before it, unless an order, a rule that acts or a change of state stands behind it, which would be forgotten.
/// @throws host::BadInput naming the journal, when it cannot be read, is of another mission, policy or ocean tables, lacks other records
/// before its end,
///         or this build does not give its outputs again.
[[nodiscard]] std::optional<Resumption> resume(const std::filesystem::path& journal, const Flown& flown, GoOnAfter after);

/// Its last record is the one that ends a journal.
[[nodiscard]] bool was_ended_in_order(const std::filesystem::path& journal);

/// A journal to be gone on with, cut to what is kept of it, and where its mission stood.
struct Unfinished {
  host::JournalFile file;
  Resumption before;
};

/// The newest of the journals that are numbered after `wanted`, when its mission goes on. Nobody else writes it meanwhile.
/// @param marked  the checksum of the first record of the only journal that counts, by the vehicle's safety record: orders in another's are
///                nobody's here; nothing: the newest counts
/// @throws as resume(), and when a part of it bears another's name, it is a link, or none is so marked; host::FolderInUse naming who writes
/// it.
[[nodiscard]] std::optional<Unfinished> find_unfinished(const std::filesystem::path& wanted, const Flown& flown, GoOnAfter after,
                                                        std::optional<std::uint32_t> marked = std::nullopt);

/// For so long the first turn of a mission that goes on at sea waits for its sensors. A detector of its own learns the noise anew.
[[nodiscard]] Duration hold_of(const config::Mission& mission, const std::optional<detector::SoundSettings>& hearing);

/// "SEARCH, after 6 steps, 3497 turns; 0 bytes behind them were cut off; 12.3 s have passed"
[[nodiscard]] std::string to_string(const Resumption& before, Time now);

}  // namespace earshot::board
