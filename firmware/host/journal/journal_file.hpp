#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// What becomes of a file of the name that a journal is to have.
enum class ExistingJournal : std::uint8_t {
  kRefuse,
  kReplace,
  kGoOn,  ///< it must be there, and is written on at its end (cut())
  kKeep,  ///< at sea: it stays, and this journal is NAME-2, NAME-3, ... so that a process that died can be started again
};

/// The last of the journals that kKeep has numbered; nothing when there is none of that name.
[[nodiscard]] std::optional<std::filesystem::path> newest_journal(const std::filesystem::path& wanted);

/// Space on the disk that is kept behind the end of a journal for what must be written though the disk is full: 300 set-points and as much
/// again for orders and the closing record.
inline constexpr std::uint64_t kJournalReserveBytes = 65'536;

/// The file of a journal, marked as one that is being written as long as it is open (FolderLock's way: forgotten with the process).
///
/// It holds space ahead of its end (fallocate(2), 64 KiB at a time), so that a disk which others have filled still takes a reserve. A file
/// system that cannot do that (EOPNOTSUPP: ext2, NFS before 4.2) has no reserve: every write may take what it gets.
class JournalFile {
 public:
  /// @throws std::system_error naming the file if it cannot be created (or exists: kRefuse; or does not: kGoOn); FolderInUse naming who
  /// writes it (kReplace, kGoOn)
  JournalFile(const std::filesystem::path& wanted, ExistingJournal existing);

  /// Before anything is written: what stands behind `size` bytes is cut off. @throws std::system_error naming the file
  void cut(std::uint64_t size);

  /// Brings the folder's entry of the file to the disk. @throws std::system_error naming the folder
  void keep_entry() const;

  /// @param kept  how many bytes of space must be held behind what is written; 0: it may take whatever the disk gives
  /// @return how many bytes the disk took, perhaps fewer than there are; 0 on failure, or when no more space can be held
  [[nodiscard]] std::size_t write_some(std::span<const std::uint8_t> bytes, std::uint64_t kept);
  /// So many bytes behind the first `size` are sure to fit and leave `kept` behind them.
  [[nodiscard]] std::uint64_t room(std::uint64_t size, std::uint64_t kept) const { return held_ > size + kept ? held_ - size - kept : 0; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Goes on after so many bytes; what stands behind them is written over, or cut off by close(). False: it goes on where it was.
  [[nodiscard]] bool go_back(std::uint64_t size);
  /// Brings what was written to the disk: it survives a power cut. False: it may not.
  [[nodiscard]] bool bring_to_disk();

  /// Lets go of the space behind the end. False: what go_back() gave up still stands there.
  [[nodiscard]] bool close();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  /// Holds another piece of space. False: there is none, or the file system cannot.
  bool hold_more();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
  std::uint64_t held_ = 0;  ///< so many bytes of the file have their place on the disk
  bool can_hold_ = true;
};

}  // namespace earshot::host
