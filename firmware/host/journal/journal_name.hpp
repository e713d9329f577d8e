#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace earshot::host {

/// Which of the journals that a folder holds a file is, and which part of it: of a journal that is wanted as journal.lcmlog,
/// "journal-2.part3.lcmlog" is the third part of the second.
struct JournalName {
  int journal = 1;
  int part = 1;
  friend bool operator==(const JournalName&, const JournalName&) = default;
};

inline constexpr int kMostJournals = 999'999;  ///< in one folder, whose numbers only rise
inline constexpr int kMostParts = 999'999;     ///< of one journal

/// The file of this name in the folder of `wanted`.
[[nodiscard]] std::filesystem::path named(const std::filesystem::path& wanted, JournalName name);

/// What a file of the folder is; nothing: none of the journals that are named after `wanted`.
[[nodiscard]] std::optional<JournalName> name_of(const std::filesystem::path& wanted, const std::filesystem::path& file);

/// Part `part` of a journal whose first is `first`, which may itself be numbered.
[[nodiscard]] std::filesystem::path part_of(const std::filesystem::path& first, int part);

/// The first part of the journal that a file is a later part of, by its name; nothing: it is named as a first part.
[[nodiscard]] std::optional<std::filesystem::path> first_part_of(const std::filesystem::path& file);

/// All that the folder of `wanted` holds of them, in no order; nothing of a folder that cannot be read.
[[nodiscard]] std::vector<JournalName> journals_beside(const std::filesystem::path& wanted);

/// The first part of the newest of them; nothing when there is none of that name.
[[nodiscard]] std::optional<std::filesystem::path> newest_journal(const std::filesystem::path& wanted);

/// What a flight calls its journal in the folder that it is given.
inline constexpr const char* kFirstJournal = "journal.lcmlog";

/// The journal that somebody means who names its folder: the newest of it; kFirstJournal of one that holds none. Any other path is itself.
[[nodiscard]] std::filesystem::path newest_journal_in(const std::filesystem::path& folder_or_journal);

/// The first part of the newest of them whose first record bears this checksum; nothing when none does.
[[nodiscard]] std::optional<std::filesystem::path> journal_marked(const std::filesystem::path& wanted, std::uint32_t first_record_crc32);

}  // namespace earshot::host
