#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/file/output_file.hpp"

namespace earshot::host {

/// Whether two paths stand for one file, there already or not, by whatever name: another spelling, a symbolic link, a hard link.
[[nodiscard]] bool are_one_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The files that one command reads and writes: none that it writes may be another of them, see are_one_file().
///
/// A name says how a person knows the file: the option that names it, or what names it in turn: "--plot", "a file of ENVIRONMENT".
/// Oracle: DistinctFiles.*
class DistinctFiles {
 public:
  /// @throws BadInput naming both when the command writes it.
  void read(const std::string& name, const std::filesystem::path& path);
  void read(const std::string& name, std::span<const std::filesystem::path> paths);
  /// @throws BadInput naming both when the command reads it, or writes it already.
  void write(const std::string& name, const std::filesystem::path& path);

 private:
  struct File {
    std::string name;
    std::filesystem::path path;
    std::filesystem::path canonical;  ///< one spelling for one place

    [[nodiscard]] bool is(const File& other) const;
  };
  [[noreturn]] static void refuse(const File& first, const File& second);

  std::vector<File> read_;
  std::vector<File> written_;
};

/// A file that a command is to write.
struct Output {
  std::string name;  ///< how a person knows it: the option that names it
  std::filesystem::path path;
  OutputKind kind;
};

/// Judges before the work what would be refused after it: see OutputFile's require_writable.
/// @param read  what the command reads; may be empty
/// @throws BadInput naming both when an output is one of these files, or another output; and as that of one file throws
void require_writable(DistinctFiles read, std::span<const Output> outputs, Replace replace);

}  // namespace earshot::host
