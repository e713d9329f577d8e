#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/journal/old_journals.hpp"

namespace earshot::host {

/// How large a journal's files may become.
struct JournalLimits {
  std::uint64_t part_bytes = 0;    ///< a part that has grown to so much is the last but one; 0: a journal is one file
  std::uint64_t budget_bytes = 0;  ///< of all journals of the folder together, older ones are deleted for it; 0: as the disk gives
};

/// What became of a part that was to be begun.
enum class PartBegun : std::uint8_t {
  kYes,
  kNo,             ///< there is no room for it, or something is in its way: the part before is written on
  kMayNotSurvive,  ///< it was, but a power cut may take it
};

/// What becomes of a file of the name that a journal is to have.
enum class ExistingJournal : std::uint8_t {
  kRefuse,
  kReplace,
  kGoOn,  ///< it must be there, and is written on at its end (cut())
  kKeep,  ///< at sea: it stays, and this journal is NAME-2, NAME-3, ... so that a process that died can be started again
};

/// Space on the disk that is kept behind the end of a journal for what must be written though the disk is full: 300 set-points and as much
/// again for orders and the closing record.
inline constexpr std::uint64_t kJournalReserveBytes = 65'536;

/// The file of a journal, marked as one that is being written as long as it is open (FolderLock's way: forgotten with the process).
///
/// It holds space ahead of its end (fallocate(2), 64 KiB at a time), so that a disk which others have filled still takes a reserve. A file
/// system that cannot do that (EOPNOTSUPP: ext2, NFS before 4.2) has no reserve: every write may take what it gets.
///
/// A journal may have several parts (JournalParts), of which the last is written. For its budget the journals of earlier flights are
/// deleted; where none is left, the disk is as full as if it had no more to give. Nothing allocates after the first byte was written.
class JournalFile {
 public:
  /// @throws std::system_error naming the file if it cannot be created (or exists: kRefuse; or does not: kGoOn); FolderInUse naming who
  /// writes it (kReplace, kGoOn)
  JournalFile(const std::filesystem::path& wanted, ExistingJournal existing);

  /// Before anything is written: what stands behind `size` bytes of all parts is cut off, and written on there. @throws std::system_error
  /// naming the file
  void cut(std::uint64_t size);
  /// Likewise before: it is one of the journals that are named after `wanted`, which share a budget.
  void count_among(const std::filesystem::path& wanted) { wanted_ = wanted; }
  /// Likewise before: as JournalLimits say.
  void keep_to(JournalLimits limits);

  /// Brings the folder's entry of the file to the disk. @throws std::system_error naming the folder
  void keep_entry() const;

  /// @param kept  how many bytes of space must be held behind what is written; 0: it may take whatever the disk gives
  /// @return how many bytes the disk took, perhaps fewer than there are; 0 on failure, or when no more space can be held
  [[nodiscard]] std::size_t write_some(std::span<const std::uint8_t> bytes, std::uint64_t kept);
  /// So many bytes behind the first `size` are sure to fit and leave `kept` behind them.
  [[nodiscard]] std::uint64_t room(std::uint64_t size, std::uint64_t kept) const { return held_ > size + kept ? held_ - size - kept : 0; }
  [[nodiscard]] std::uint64_t size() const { return size_; }  ///< of the part that is written
  [[nodiscard]] bool is_part_full() const { return limits_.part_bytes > 0 && size_ >= next_part_at_; }
  /// Between two records: what is written from now on goes into another file.
  /// @param is_to_survive  a power cut
  [[nodiscard]] PartBegun begin_part(bool is_to_survive);
  /// Goes on after so many bytes; what stands behind them is written over, or cut off by close(). False: it goes on where it was.
  [[nodiscard]] bool go_back(std::uint64_t size);
  /// Brings what was written to the disk: it survives a power cut. False: it may not.
  [[nodiscard]] bool bring_to_disk();

  /// Lets go of the space behind the end. False: what go_back() gave up still stands there.
  [[nodiscard]] bool close();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  ///< of the first part
  /// Journals of earlier flights that were deleted for the budget.
  [[nodiscard]] std::size_t deleted() const { return old_.deleted(); }
  /// The number of the last of them; 0: none was.
  [[nodiscard]] int last_deleted() const { return old_.last_deleted(); }

 private:
  /// Holds another piece of space. False: there is none, or the file system cannot.
  bool hold_more();
  /// So many bytes more are within the budget, perhaps for the older journals that this deletes.
  bool has_budget_for(std::uint64_t bytes);
  void open(const std::filesystem::path& wanted, ExistingJournal existing);
  /// The next byte goes there.
  void write_on_at(const JournalParts::Place& place, std::uint64_t earlier);
  void note_first_bytes(std::span<const std::uint8_t> bytes);
  [[nodiscard]] PartBegun refuse_part();
  /// "journal.part" and the number, in memory of its own. @return null: too long
  [[nodiscard]] const char* name_of_part(int part);

  std::filesystem::path path_;
  std::filesystem::path wanted_;
  JournalLimits limits_;
  FileDescriptor file_;
  FileDescriptor first_;   ///< the first part, which bears the mark, while another is written
  FileDescriptor folder_;  ///< for its entries
  OldJournals old_;
  int part_ = 1;
  std::uint64_t earlier_bytes_ = 0;          ///< of the parts before
  std::uint64_t next_part_at_ = 0;           ///< bytes of this one
  std::array<std::uint8_t, 8> beginning_{};  ///< of the first part: it names the journal
  std::string name_;                         ///< as name_of_part() writes it, with room for the largest number
  std::size_t stem_bytes_ = 0;
  std::string extension_;
  std::uint64_t size_ = 0;
  std::uint64_t held_ = 0;  ///< so many bytes of the file have their place on the disk
  bool can_hold_ = true;
};

}  // namespace earshot::host
