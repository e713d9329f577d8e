#include "sim/ocean/file/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

#include "firmware/host/file/input_file.hpp"

namespace earshot::ocean {
namespace {

using host::BadInput;

std::string trimmed(const std::string& text) {
  const char* const blank = " \t\r\"";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
  return cells;
}

std::optional<double> finite_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

CsvTable::CsvTable(std::filesystem::path path) : path_(std::move(path)) {
  std::istringstream stream(host::read_text(path_, host::kCsvFile));
  std::size_t line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // the mark that spreadsheets put before UTF-8
    if (trimmed(text).empty() || text.starts_with('#')) continue;
    if (names_.empty()) {
      names_ = split(text);
      require_distinct_names();
      columns_.resize(names_.size());
    } else {
      read_row(text, line);
    }
  }
  if (rows() == 0) throw BadInput(path_.string() + ": must have a header line and at least one line of numbers");
}

void CsvTable::require_distinct_names() const {
  for (auto name = names_.begin(); name != names_.end(); ++name) {
    if (std::find(names_.begin(), name, *name) != name) throw BadInput(path_.string() + ": has two columns " + *name);
  }
}

void CsvTable::read_row(const std::string& text, std::size_t line) {
  const std::string where = path_.string() + ":" + std::to_string(line) + ": ";
  const std::vector<std::string> cells = split(text);
  if (cells.size() != names_.size()) {
    throw BadInput(where + "has " + std::to_string(cells.size()) + " values, the header has " + std::to_string(names_.size()));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::optional<double> value = finite_number(cells[i]);
    if (!value) throw BadInput(where + names_[i] + " = " + (cells[i].empty() ? "nothing" : cells[i]) + ": must be a finite number");
    columns_[i].push_back(*value);
  }
  line_.push_back(line);
}

bool CsvTable::has(std::string_view column) const {
  return std::find(names_.begin(), names_.end(), column) != names_.end();
}

const std::vector<double>& CsvTable::column(std::string_view column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found != names_.end()) return columns_[static_cast<std::size_t>(found - names_.begin())];
  std::string names;
  for (const std::string& name : names_) names += (names.empty() ? "" : ", ") + name;
  throw BadInput(path_.string() + ": must have a column " + std::string(column) + ", has: " + names);
}

BadInput CsvTable::error(std::size_t row, std::string_view column, const std::string& what) const {
  std::ostringstream text;
  text << path_.string() << ':' << line_[row] << ": " << column << " = " << this->column(column)[row] << ": " << what;
  return BadInput(text.str());
}

void CsvTable::check(std::string_view column, host::Range allowed) const {
  const std::vector<double>& values = this->column(column);
  const auto outside = std::find_if(values.begin(), values.end(), [&](double x) { return !allowed.allows(x); });
  if (outside != values.end()) throw error(static_cast<std::size_t>(outside - values.begin()), column, to_string(allowed));
}

}  // namespace earshot::ocean
