#include "firmware/host/safety_record/in_memory.hpp"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/sysmacros.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

/// The folder or, where it is not there, the one in which the first that is missing would be made.
fs::path nearest_that_is(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error).lexically_normal();
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// The kernel writes blanks and backslashes of a path as \040 and \134; an overlay's own comma or colon has a backslash before it.
std::string unescaped(std::string_view text) {
  constexpr std::string_view kOctal = "01234567";
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_octal = text[i] == '\\' && i + 3 < text.size() && text.find_first_not_of(kOctal, i + 1) > i + 3;
    if (is_octal) {
      plain += static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

/// Of the options of an overlay.
std::optional<fs::path> upper_in(const std::string& options) {
  constexpr std::string_view kUpper = "upperdir=";
  const std::string all = "," + unescaped(options);
  const std::size_t at = all.find("," + std::string(kUpper));
  if (at == std::string::npos) return std::nullopt;
  std::string upper;
  for (std::size_t i = at + 1 + kUpper.size(); i < all.size() && all[i] != ','; ++i) {
    if (all[i] == '\\' && i + 1 < all.size()) ++i;
    upper += all[i];
  }
  return upper;
}

std::string device_of(const struct stat& status) {
  return std::to_string(major(status.st_dev)) + ":" + std::to_string(minor(status.st_dev));
}

}  // namespace

std::optional<fs::path> upper_layer(std::string_view mounts, std::string_view device) {
  std::istringstream lines{std::string(mounts)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string number;
    std::string parent;
    std::string of;
    std::string word;
    words >> number >> parent >> of;
    if (of != device) continue;
    while (words >> word && word != "-") {
    }
    std::string kind;
    std::string options;
    words >> kind >> word >> options;
    if (kind == "overlay") return upper_in(options);
  }
  return std::nullopt;
}

bool is_in_memory(const fs::path& folder) {
  const fs::path there = nearest_that_is(folder);
  struct statfs disk {};
  struct stat status {};
  if (::statfs(there.c_str(), &disk) != 0 || ::stat(there.c_str(), &status) != 0) return false;
  if (disk.f_type == TMPFS_MAGIC || disk.f_type == RAMFS_MAGIC) return true;
  if (disk.f_type != OVERLAYFS_SUPER_MAGIC) return false;
  std::ifstream mounts("/proc/self/mountinfo");
  const std::string all{std::istreambuf_iterator<char>(mounts), {}};
  const std::optional<fs::path> upper = upper_layer(all, device_of(status));
  return upper && upper->is_absolute() && ::statfs(upper->c_str(), &disk) == 0 &&
         (disk.f_type == TMPFS_MAGIC || disk.f_type == RAMFS_MAGIC);
}

}  // namespace earshot::host
