#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace earshot::journal {

/// Whether a program has marked the file as one that it is writing.
[[nodiscard]] bool is_being_written(const std::filesystem::path& journal);

/// The journal of the mission under way that somebody means who names a journal, or the folder that it is to be in: of a folder the newest
/// that is being written. A flight of `earshot fly` writes in a folder
/// unfinished-flight beside the journal of the flight before, whose place it takes at its end. Nothing: no mission is under way there
/// yet; the journal of a simulated flight that nobody writes is an older flight's.
[[nodiscard]] std::optional<std::filesystem::path> journal_under_way(const std::filesystem::path& folder_or_journal);

/// Waits for it, and says so. @return nothing: a signal stopped the program
/// @throws host::BadInput when it did not come within that time
[[nodiscard]] std::optional<std::filesystem::path> wait_for_journal(const std::filesystem::path& folder_or_journal,
                                                                    std::chrono::seconds most);

}  // namespace earshot::journal
