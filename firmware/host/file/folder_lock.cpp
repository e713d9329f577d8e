#include "firmware/host/file/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "firmware/host/file/process_name.hpp"

namespace earshot::host {
namespace {

[[noreturn]] void fail(const std::filesystem::path& folder) {
  throw std::system_error(errno, std::generic_category(), folder.string());
}

/// The process that holds a lock on the file of this inode, as the kernel lists it:
/// "1: FLOCK  ADVISORY  WRITE 23873 fe:00:9994321 0 EOF".
std::optional<std::string> holder_of(const std::string& inode) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, manner, access, process, file;
    words >> number >> kind >> manner >> access >> process >> file;
    if (kind == "FLOCK" && file.ends_with(":" + inode)) return process;
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const FileDescriptor& file, const std::filesystem::path& path, const char* what) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail(path);
  const std::optional<std::string> holder = holder_of(std::to_string(status.st_ino));
  throw FolderInUse(path.string() + ": " + (holder ? name_of_process(*holder) : "another program") + " is writing " + what);
}

}  // namespace

FileDescriptor lock_folder(const std::filesystem::path& folder) {
  FileDescriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.number() < 0) fail(folder);
  if (::flock(lock.number(), LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno != EWOULDBLOCK) fail(folder);
  refuse(lock, folder, "into this folder");
}

void mark_as_written(const FileDescriptor& file, const std::filesystem::path& path) {
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse(file, path, "this file");
}

void require_not_being_written(const std::filesystem::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() >= 0) mark_as_written(file, path);
}

}  // namespace earshot::host
