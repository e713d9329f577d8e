#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/toml/range.hpp"
#include "sim/netcdf/file_error.hpp"
#include "sim/netcdf/header.hpp"

namespace earshot::netcdf {

/// Part of a variable: along each of its dimensions the first index and how many.
struct Block {
  std::vector<std::size_t> start;
  std::vector<std::size_t> count;
};

enum class Missing : std::uint8_t { kRefused, kAllowed };

/// A NetCDF file (classic or NetCDF-4). Whatever is missing, truncated or of another shape throws FileError, and so does a damaged NetCDF-4
/// file that crashes the library or keeps it busy without end: this process never opens one. A child (run_apart) does, anew for the header
/// and for each block, and hands over what it has read.
///
/// Not for two threads at once: the NetCDF library is not thread-safe, not even for different files.
class Reader {
 public:
  explicit Reader(std::filesystem::path path);
  ~Reader();  // out of line: it knows what OpenFile is
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[nodiscard]] bool has_variable(const std::string& variable) const;
  [[nodiscard]] std::vector<std::string> dimensions_of(const std::string& variable) const;
  [[nodiscard]] std::vector<std::size_t> shape_of(const std::string& variable) const;
  /// @param variable  empty: of the whole file
  [[nodiscard]] std::optional<std::string> text_attribute(const std::string& variable, const std::string& attribute) const;

  /// The values in row-major order, unpacked; NaN where the file has none (see Packing). At most 2^28 values.
  [[nodiscard]] std::vector<double> read(const std::string& variable) const;
  [[nodiscard]] std::vector<double> read(const std::string& variable, const Block& block) const;

  /// Throws "FILE: VARIABLE[0, 3, 17] = 1e+30: must be ..." for the first value of a block that is not allowed. A missing one is NaN.
  /// @param values  of the block, as read() gave them
  void require(const std::string& variable, const Block& block, std::span<const double> values, const host::Range& allowed,
               Missing missing = Missing::kRefused) const;
  /// The same of a whole variable of one dimension, or of none.
  void require(const std::string& variable, std::span<const double> values, const host::Range& allowed) const;

  /// An error about one value: "FILE: VARIABLE[0, 3, 17] = 1e+30: reason". @param index  in the block, row by row
  [[nodiscard]] FileError error(const std::string& variable, const Block& block, std::size_t index, double value,
                                const std::string& what) const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// An error about this file.
  [[nodiscard]] FileError error(const std::string& variable, const std::string& what) const;

 private:
  class OpenFile;

  [[nodiscard]] const Variable& find(const std::string& variable) const;
  /// Of a file that a child opens. Throws what is wrong with it.
  [[nodiscard]] Header header_apart() const;
  /// The values of a block that the variable holds. @return the library's status
  [[nodiscard]] int get(const std::string& variable, const Block& block, std::vector<double>& values) const;
  /// Throws unless a child process came to an end of its own.
  void require_sound(const std::optional<std::string>& end) const;
  void require_open(int status) const;

  std::filesystem::path path_;
  std::unique_ptr<OpenFile> classic_;  ///< null: NetCDF-4, which a child opens
  Header header_;
};

}  // namespace earshot::netcdf
