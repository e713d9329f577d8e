#include "firmware/host/file/file_type.hpp"

#include <sys/stat.h>

#include <cstddef>

namespace earshot::host {

const char* type_name(mode_t mode) {
  if (S_ISREG(mode)) return "a regular file";
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string suffix_of(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::size_t point = name.rfind('.');
  std::string suffix = point == std::string::npos ? std::string() : name.substr(point);
  for (char& c : suffix) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return suffix;
}

}  // namespace earshot::host
