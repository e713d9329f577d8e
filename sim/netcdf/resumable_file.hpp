#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/netcdf/file_error.hpp"
#include "sim/netcdf/reader.hpp"
#include "sim/netcdf/writer.hpp"

namespace earshot::netcdf {

struct VariableLayout {
  std::string name;
  Type type;
  std::vector<std::string> dimensions;
  Attributes attributes;
  std::optional<double> fill = {};       ///< what stands where nothing was written yet
  std::vector<double> flag_values = {};  ///< what the words of the attribute flag_meanings stand for; empty: no flags
};

/// All of a file but its values.
struct Layout {
  Attributes attributes;  ///< of the file; also what tells that a file was begun for the same purpose
  std::vector<std::pair<std::string, std::size_t>> dimensions;
  std::vector<VariableLayout> variables;
};

/// A NetCDF file of fixed shape that is written over hours and may be interrupted at any moment, by SIGKILL or a power cut, and taken up
/// again. It stands under "FILE.partial" until `commit` gives it its own name.
///
/// Its format is CDF-5 and not NetCDF-4: every value has its place in the file from the start, nothing but values changes afterwards, so
/// that a killed process leaves a whole file, and the bytes do not depend on the order or the number of sittings it was written in. All its
/// room on the disk is taken at the beginning: a disk too small is known before the work.
///
/// Not for two threads at once, as Reader; a second process is refused.
class ResumableFile {
 public:
  /// Takes up FILE.partial if there is one, else begins it.
  /// Throws FileError when it was begun with another layout, is in use, or cannot be written, and when FILE itself is there already.
  ResumableFile(std::filesystem::path path, const Layout& layout);
  ~ResumableFile();
  ResumableFile(const ResumableFile&) = delete;
  ResumableFile& operator=(const ResumableFile&) = delete;

  /// Whether a finished file of this name and layout stands there already. Throws FileError when something else has the name: hours of
  /// work are not overwritten, and not begun when their result will find no place.
  [[nodiscard]] static bool is_finished(const std::filesystem::path& path, const Layout& layout);

  [[nodiscard]] std::vector<double> read(const std::string& variable) const;
  void write(const std::string& variable, const Block& block, std::span<const float> values);
  void write(const std::string& variable, const Block& block, std::span<const double> values);
  void flush();   ///< returns when all that was written is on the disk
  void commit();  ///< flushes, and gives the file its name

 private:
  [[nodiscard]] int variable_id(const std::string& variable) const;
  void check(int status, const std::string& variable) const;
  void close();

  std::filesystem::path path_;
  std::filesystem::path partial_;
  int file_ = -1;        ///< of the NetCDF library
  int descriptor_ = -1;  ///< of the same file, for locking and fsync
};

}  // namespace earshot::netcdf
