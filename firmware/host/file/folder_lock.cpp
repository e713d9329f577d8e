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

/// "earshot-fly (process 4711)"
std::string name_of(const std::string& process) {
  std::string name = "a program";
  std::ifstream comm("/proc/" + process + "/comm");
  std::getline(comm, name);
  return name + " (process " + process + ")";
}

}  // namespace

FileDescriptor lock_folder(const std::filesystem::path& folder) {
  FileDescriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.number() < 0) fail(folder);
  if (::flock(lock.number(), LOCK_EX | LOCK_NB) == 0) return lock;
  if (errno != EWOULDBLOCK) fail(folder);
  struct stat status {};
  if (::fstat(lock.number(), &status) != 0) fail(folder);
  const std::optional<std::string> holder = holder_of(std::to_string(status.st_ino));
  throw FolderInUse(folder.string() + ": " + (holder ? name_of(*holder) : "another program") + " is writing into this folder");
}

}  // namespace earshot::host
