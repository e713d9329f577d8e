#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// What becomes of a file of the name that a journal is to have.
enum class ExistingJournal : std::uint8_t {
  kRefuse,
  kReplace,
  kKeep,  ///< at sea: it stays, and this journal is NAME-2, NAME-3, ... so that a process that died can be started again
};

/// The file of a journal, marked as one that is being written as long as it is open (FolderLock's way: forgotten with the process).
class JournalFile {
 public:
  /// @throws std::system_error naming the file if it cannot be created (or exists: kRefuse); FolderInUse naming who writes it (kReplace)
  JournalFile(const std::filesystem::path& wanted, ExistingJournal existing);

  /// Brings the folder's entry of the file to the disk. @throws std::system_error naming the folder
  void keep_entry() const;

  /// @return how many bytes the disk took, perhaps fewer than there are; 0 on failure
  [[nodiscard]] std::size_t write_some(std::span<const std::uint8_t> bytes);
  /// Cuts the file after so many bytes and goes on there. False: it is as long as it was.
  [[nodiscard]] bool cut(std::uint64_t size);
  /// Brings what was written to the disk: it survives a power cut. False: it may not.
  [[nodiscard]] bool bring_to_disk();

  void close() { file_ = FileDescriptor(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace earshot::host
