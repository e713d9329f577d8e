#include "firmware/host/file/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "firmware/host/file/process.hpp"

namespace earshot::host {
namespace {

[[noreturn]] void fail(const std::filesystem::path& folder) {
  throw std::system_error(errno, std::generic_category(), folder.string());
}

struct Holder {
  std::string process;
  bool is_alone = true;  ///< the lock is not shared
};

/// The processes that hold a lock on the file of this inode, as the kernel lists them:
/// "1: FLOCK  ADVISORY  WRITE 23873 fe:00:9994321 0 EOF".
std::vector<Holder> holders_of(ino_t inode) {
  std::vector<Holder> holders;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, manner, access, process, file;
    words >> number >> kind >> manner >> access >> process >> file;
    if (kind == "FLOCK" && file.ends_with(":" + std::to_string(inode)))
      holders.push_back({.process = process, .is_alone = access == "WRITE"});
  }
  return holders;
}

/// Empty: it cannot be told.
std::string program_of(const std::string& process) {
  std::string name;
  std::getline(std::ifstream("/proc/" + process + "/comm") >> std::ws, name);
  return name;
}

[[noreturn]] void refuse(const FileDescriptor& file, const std::filesystem::path& path, const char* what) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail(path);
  const std::vector<Holder> holders = holders_of(status.st_ino);
  throw FolderInUse(path.string() + ": " + (holders.empty() ? "another program" : name_of_process(holders.front().process)) +
                    " is writing " + what);
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

MarkedBy marked_by(const FileDescriptor& file) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return MarkedBy::kThisProgram;
  std::vector<Holder> holders = holders_of(status.st_ino);
  if (holders.empty()) return MarkedBy::kThisProgram;
  const std::string own = program_of("self");
  std::erase_if(holders, [&](const Holder& holder) {
    const std::string program = program_of(holder.process);
    return !holder.is_alone || (!program.empty() && program != own);
  });
  if (holders.empty()) return MarkedBy::kAnotherProgram;
  const auto is_killed_holder = [](const Holder& holder) { return is_killed("/proc/" + holder.process); };
  return std::ranges::all_of(holders, is_killed_holder) ? MarkedBy::kTheKilled : MarkedBy::kThisProgram;
}

void require_not_being_written(const std::filesystem::path& path) {
  // Shared: of several programs that ask at the same time none takes another for the writer.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() >= 0 && ::flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse(file, path, "this file");
}

}  // namespace earshot::host
