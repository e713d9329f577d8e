#include "firmware/host/trust/strict_modes.hpp"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <set>
#include <string>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"

namespace earshot::host {
namespace {

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
constexpr int kMostLinks = 40;  // as Linux follows

std::string name_of(uid_t user) {
  const passwd* const entry = ::getpwuid(user);
  return entry == nullptr ? "user " + std::to_string(user) : std::string(entry->pw_name);
}

/// What is wrong on the way to some files, each thing once.
class Findings {
 public:
  Findings() {
    struct stat root {};
    if (::stat("/", &root) == 0) owner_of_root_ = root.st_uid;
  }

  void judge(const std::filesystem::path& path, const struct stat& status) {
    if (!judged_.insert(path).second) return;
    const bool is_ours = status.st_uid == 0 || status.st_uid == ::geteuid() || status.st_uid == owner_of_root_;
    if (!is_ours) {
      add(printable(path.string()) + " belongs to " + name_of(status.st_uid));
      to_own_ += " " + path.string();
    }
    const bool is_sticky = S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0;
    if (S_ISLNK(status.st_mode) || is_sticky || (status.st_mode & kOthersWrite) == 0) return;
    const bool is_everybodys = (status.st_mode & S_IWOTH) != 0;
    add(printable(path.string()) + " may be written by " + (is_everybodys ? "everybody" : "its group"));
    to_close_ += " " + path.string();
  }

  void require_none(const std::filesystem::path& first) const {
    if (wrong_.empty()) return;
    std::string remedy;
    if (!to_close_.empty()) remedy += "chmod go-w" + to_close_;
    if (!to_own_.empty()) remedy += (remedy.empty() ? "" : " && ") + std::string("chown root") + to_own_;
    const std::string user = ::geteuid() == 0 ? std::string() : " and " + name_of(::geteuid());
    throw BadInput(first.string() + ": whom the vehicle trusts can be changed by others than root" + user + ", who runs this: " + wrong_ +
                   ". What mends it: " + remedy + (to_own_.empty() ? std::string() : " (or run this as their owner)"));
  }

 private:
  void add(const std::string& what) { wrong_ += (wrong_.empty() ? "" : "; ") + what; }

  uid_t owner_of_root_ = 0;
  std::set<std::filesystem::path> judged_;
  std::string wrong_;
  std::string to_close_;
  std::string to_own_;
};

/// Goes from the root to the file, and where a link leads. What is not there ends the way: nobody else can put it there.
void judge_way(const std::filesystem::path& file, Findings& findings) {
  const std::filesystem::path whole = std::filesystem::absolute(file);
  std::deque<std::filesystem::path> rest(whole.begin(), whole.end());
  std::filesystem::path at = "/";
  for (int links = 0; !rest.empty();) {
    const std::filesystem::path part = rest.front();
    rest.pop_front();
    if (part == "." || part.empty()) continue;
    const std::filesystem::path next = part == ".." ? at.parent_path() : (part.is_absolute() ? part : at / part);
    struct stat status {};
    if (::lstat(next.c_str(), &status) != 0) {
      if (errno == ENOENT || errno == ENOTDIR) return;
      throw BadInput(printable(file.string()) + ": cannot be judged: " + printable(next.string()) + ": " + std::strerror(errno));
    }
    findings.judge(next, status);
    if (!S_ISLNK(status.st_mode)) {
      at = next;
      continue;
    }
    if (++links > kMostLinks) throw BadInput(printable(file.string()) + ": leads from link to link");
    const std::filesystem::path target = std::filesystem::read_symlink(next);
    rest.insert(rest.begin(), target.begin(), target.end());
  }
}

}  // namespace

void require_strict_modes(const std::vector<std::filesystem::path>& files) {
  Findings findings;
  for (const std::filesystem::path& file : files) judge_way(file, findings);
  findings.require_none(files.front());
}

}  // namespace earshot::host
