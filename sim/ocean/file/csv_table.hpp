#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::ocean {

/// A table of numbers with named columns: comma-separated, a header line first, empty lines and lines that begin with # left out.
class CsvTable {
 public:
  /// Throws host::BadInput, naming line and column, for a value that is missing, not a number or not finite.
  /// Oracle: CsvTable.*
  explicit CsvTable(std::filesystem::path path);

  [[nodiscard]] bool has(std::string_view column) const;
  /// Throws host::BadInput when there is no such column.
  [[nodiscard]] const std::vector<double>& column(std::string_view column) const;
  [[nodiscard]] std::size_t rows() const { return line_.size(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// An error about one row: "FILE:LINE: COLUMN = VALUE: what".
  [[nodiscard]] host::BadInput error(std::size_t row, std::string_view column, const std::string& what) const;

  /// Throws when a value of the column lies outside.
  void check(std::string_view column, host::Range allowed) const;

 private:
  void require_distinct_names() const;
  void read_row(const std::string& text, std::size_t line);

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
  std::vector<std::size_t> line_;  ///< in the file, of each row
};

}  // namespace earshot::ocean
