#pragma once

#include <filesystem>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// Another program is writing into the folder or the file; the message says which.
class FolderInUse : public BadInput {
 public:
  using BadInput::BadInput;
};

/// Marks a folder as one that is being written. The kernel forgets the mark with the process, however that ends, and nothing is left in
/// the folder. It holds among programs that ask for it, on this machine; a file system that cannot lock a folder (NFS) is refused.
/// @param folder  it exists
/// @return the lock, held as long as this is kept
/// @throws FolderInUse, std::system_error naming the folder
/// Oracle: FolderLock.*
[[nodiscard]] FileDescriptor lock_folder(const std::filesystem::path& folder);

/// Likewise a file that is open, as long as it is. Where the file system cannot lock, it is written all the same.
/// @param path  of the file, for the message
/// @throws FolderInUse
void mark_as_written(const FileDescriptor& file, const std::filesystem::path& path);

enum class MarkedBy {
  kThisProgram,     ///< by another process of it, or it cannot be told
  kAnotherProgram,  ///< one that only reads it (a backup): its lock is shared, or it has another name
  kTheKilled,       ///< by a process of this program that has been killed and runs no more (is_killed()): a disk that hangs keeps its locks
};

/// Who has marked a file that somebody has marked, by the kernel's list of locks and the processes' names.
[[nodiscard]] MarkedBy marked_by(const FileDescriptor& file);

/// @throws FolderInUse when somebody has marked this file as one that is being written
void require_not_being_written(const std::filesystem::path& path);

}  // namespace earshot::host
