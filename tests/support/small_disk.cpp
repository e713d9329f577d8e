#include "tests/support/small_disk.hpp"

#include <sched.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace earshot::support {
namespace {

std::string size_option(std::uint64_t bytes) {
  return "size=" + std::to_string(bytes);
}

bool enter_private_mounts() {
  const std::string user = std::to_string(::geteuid());
  const std::string group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWNS) != 0) {
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " + user + " 1";
    std::ofstream("/proc/self/gid_map") << "0 " + group + " 1";
  }
  return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

}  // namespace

std::unique_ptr<SmallDisk> SmallDisk::make(std::uint64_t bytes) {
  if (!enter_private_mounts()) return nullptr;
  std::string name = (std::filesystem::temp_directory_path() / "earshot-disk-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return nullptr;
  std::unique_ptr<SmallDisk> disk(new SmallDisk(name));
  if (::mount("tmpfs", name.c_str(), "tmpfs", 0, size_option(bytes).c_str()) != 0) return nullptr;
  return disk;
}

SmallDisk::~SmallDisk() {
  (void)::umount2(path_.c_str(), MNT_DETACH);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

bool SmallDisk::resize(std::uint64_t bytes) const {
  return ::mount("tmpfs", path_.c_str(), "tmpfs", MS_REMOUNT, size_option(bytes).c_str()) == 0;
}

bool SmallDisk::set_read_only(bool is_read_only) const {
  return ::mount("tmpfs", path_.c_str(), "tmpfs", MS_REMOUNT | (is_read_only ? MS_RDONLY : 0), "") == 0;
}

}  // namespace earshot::support
