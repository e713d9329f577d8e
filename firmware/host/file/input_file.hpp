#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// What a file is, and how large such a file may be. A larger one is refused before a byte of it is read.
struct FileKind {
  const char* name;  ///< with its article: "a CSV table"
  std::uint64_t most_bytes;
};

// Each holds several times the largest that is of use, and what it becomes in memory stays under 1 GiB.

/// Most is in a library's positions when they stand there one by one: some 200 000.
inline constexpr FileKind kTomlFile{"a TOML file", std::uint64_t{4} << 20U};
/// A track of a week at one row a second.
inline constexpr FileKind kCsvFile{"a CSV table", std::uint64_t{64} << 20U};
/// A flight's summary, or what a model was trained to search.
inline constexpr FileKind kJsonFile{"a JSON file", std::uint64_t{4} << 20U};
/// A checkpoint, a .zip of Stable-Baselines3 or an ONNX export; a network larger than the runtime's capacities cannot be frozen.
inline constexpr FileKind kModelFile{"a trained model", std::uint64_t{64} << 20U};
/// 64 digits.
inline constexpr FileKind kKeyFile{"a key", 256};
/// Read piece by piece, or by a library that takes no more of it than is asked for.
inline constexpr FileKind kAnySize{"a file", std::numeric_limits<std::uint64_t>::max()};

/// A regular file, open for reading from its beginning. What is none (a pipe, a device, a socket, a folder) is refused without being
/// opened: a pipe may block for ever, a device may never end, and opening some devices does something.
///
/// A path such as /dev/stdin is followed to what it stands for: `program /dev/stdin <file` reads the file, `program <(command)` is refused,
/// because files are read more than once (their checksums) and paths in them are relative to their folder.
/// Oracle: InputFile.*
class InputFile {
 public:
  /// Throws BadInput naming the file when it is not there, is not a regular file, may not be read or is too large.
  InputFile(std::filesystem::path path, FileKind kind);

  /// Fills `into`; less is read only at the end of the file. Throws BadInput when the disk fails or the file has outgrown its kind.
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into);

  /// The next read() begins so many bytes behind the file's beginning. Throws BadInput when the disk fails.
  void go_to(std::uint64_t offset);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
  [[nodiscard]] mode_t mode() const { return mode_; }         ///< who might read and write it, when it was opened

 private:
  std::filesystem::path path_;
  FileKind kind_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
  mode_t mode_ = 0;
  std::uint64_t read_ = 0;
};

/// The whole content of a file. Throws as InputFile does.
[[nodiscard]] std::string read_text(const std::filesystem::path& path, FileKind kind);
[[nodiscard]] std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, FileKind kind);

}  // namespace earshot::host
