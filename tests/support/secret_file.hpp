#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace earshot::support {

/// A file that its owner alone may read, as a secret key must be.
inline void write_secret_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  stream << text;
}

}  // namespace earshot::support
