#pragma once

#include <filesystem>
#include <vector>

namespace earshot::host {

/// The files that one command reads and writes: none that it writes may be another of them, whatever links lead to it.
class DistinctFiles {
 public:
  void read(const std::filesystem::path& path);
  /// @throws BadInput naming the file when the command reads it, or writes it already.
  void write(const std::filesystem::path& path);

 private:
  std::vector<std::filesystem::path> taken_;
};

}  // namespace earshot::host
