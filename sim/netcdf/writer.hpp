#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "sim/netcdf/conventions.hpp"
#include "sim/netcdf/file_error.hpp"
#include "sim/netcdf/reader.hpp"

namespace earshot::netcdf {

enum class Type : std::uint8_t { kFloat, kDouble, kInt16, kInt32 };

/// A NetCDF-4 file in the making. It stands under a temporary name in the same folder (host::OutputFile) and gets its own only at `commit`;
/// destroyed before that, it leaves nothing. A file that cannot be made or named (no such folder, no right, a pipe or a device in its
/// place) throws host::BadInput, values that cannot be written (disk full) FileError, which is one.
///
///     netcdf::Writer file("field.nc");
///     file.dimension("range", 100);
///     file.variable("range", netcdf::Type::kDouble, {"range"}, {{"units", "m"}, {"long_name", "range from the source"}});
///     file.write("range", range_m);
///     file.commit();
///
/// Not for two threads at once, as Reader.
class Writer {
 public:
  explicit Writer(std::filesystem::path path);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void dimension(const std::string& name, std::size_t length);
  void variable(const std::string& name, Type type, const std::vector<std::string>& dimensions, const Attributes& attributes);
  /// Without loss, before its values are written: chunks of 64 KiB that hold whole rows, so that no more than a chunk is read for a row.
  void compress(const std::string& variable);
  void attribute(const std::string& name, const std::string& value);  ///< of the file
  void attribute(const std::string& name, double value);              ///< of the file
  void attribute(const std::string& variable, const std::string& name, double value);
  void write(const std::string& variable, std::span<const double> values);  ///< all of it, row-major; converted to the variable's type
  void write(const std::string& variable, std::span<const float> values);
  void write(const std::string& variable, const Block& block, std::span<const double> values);
  void write(const std::string& variable, const Block& block, std::span<const float> values);
  void commit();

 private:
  [[nodiscard]] int variable_id(const std::string& variable) const;
  [[nodiscard]] Block all_of(const std::string& variable) const;
  void check(int status, const std::string& variable) const;
  void check_size(const std::string& variable, const Block& block, std::size_t values) const;

  std::filesystem::path path_;
  host::OutputFile whole_;
  int file_ = -1;  ///< -1: closed
};

}  // namespace earshot::netcdf
