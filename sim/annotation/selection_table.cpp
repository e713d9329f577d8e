#include "sim/annotation/selection_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::annotation {
namespace {

/// A million selections, ten times what a year of song has.
constexpr host::FileKind kTableFile{"a Raven selection table", std::uint64_t{256} << 20U};
constexpr std::size_t kMostProblems = 20;
constexpr double kLatest_s = 1e9;  // thirty years
constexpr double kHighest_hz = 1e7;

constexpr std::string_view kSelection = "Selection";
constexpr std::string_view kChannel = "Channel";
constexpr std::string_view kBegin = "Begin Time (s)";
constexpr std::string_view kEnd = "End Time (s)";
constexpr std::string_view kLow = "Low Freq (Hz)";
constexpr std::string_view kHigh = "High Freq (Hz)";
constexpr std::string_view kFile = "Begin File";
constexpr std::string_view kOffset = "File Offset (s)";

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return {text.data(), static_cast<std::size_t>(size)};
}

/// A name may hold what parts columns and lines.
std::string one_cell(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::vector<std::string_view> split(std::string_view line, char at) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t end = line.find(at);
    cells.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

class TableParser {
 public:
  TableParser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  SelectionTable parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // a byte order mark
    read_header();
    SelectionTable table;
    while (!text_.empty()) {
      cells_ = split(next_line(), '\t');
      if (cells_.size() == 1 && cells_.front().find_first_not_of(' ') == std::string_view::npos) continue;
      if (problems_ < kMostProblems) read_line(table);
    }
    if (problems_ > 0) throw host::BadInput(complaint_);
    return table;
  }

 private:
  std::string_view next_line() {
    ++line_;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void read_header() {
    header_ = split(next_line(), '\t');
    for (const std::string_view needed : {kBegin, kEnd})
      if (!column(needed))
        throw host::BadInput(name_ + ": is no Raven selection table: its first line has no column \"" + std::string(needed) + "\"");
  }

  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const {
    const auto found = std::ranges::find(header_, name);
    return found == header_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - header_.begin()));
  }

  [[nodiscard]] std::string_view cell(std::string_view name) const {
    const std::optional<std::size_t> at = column(name);
    return at && *at < cells_.size() ? cells_[*at] : std::string_view();
  }

  void note(std::string_view column, const std::string& what) {
    if (++problems_ > kMostProblems) return;
    if (!complaint_.empty()) complaint_ += '\n';
    complaint_ += name_ + ":" + std::to_string(line_) + ": " + std::string(column) + " = " + std::string(cell(column)) + ": " + what;
  }

  double number(std::string_view column, double highest, std::optional<double> otherwise = {}) {
    const std::string_view text = cell(column);
    if (text.empty() && otherwise) return *otherwise;
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    if (is_number && value >= 0.0 && value <= highest) return value;
    note(column, "must be a number from 0 to " + fixed(highest, 0));
    return 0.0;
  }

  void read_line(SelectionTable& table) {
    const std::size_t before = problems_;
    Selection selection{.begin_s = number(kBegin, kLatest_s),
                        .end_s = number(kEnd, kLatest_s),
                        .low_hz = number(kLow, kHighest_hz, 0.0),
                        .high_hz = number(kHigh, kHighest_hz, 0.0),
                        .channel = static_cast<int>(number(kChannel, 1024.0, 1.0)),
                        .begin_file = std::string(cell(kFile)),
                        .file_offset_s = number(kOffset, kLatest_s, 0.0),
                        .values = {}};
    if (problems_ == before && selection.end_s < selection.begin_s) note(kEnd, "lies before the begin");
    if (problems_ > before) return;
    const std::string number_of(cell(kSelection));
    const bool is_new = number_of.empty() || seen_.emplace(number_of, selection.begin_s, selection.end_s, selection.channel).second;
    if (is_new) table.selections.push_back(std::move(selection));
  }

  std::string_view text_;
  std::string name_;
  std::size_t line_ = 0;
  std::vector<std::string_view> header_;
  std::vector<std::string_view> cells_;
  std::set<std::tuple<std::string, double, double, int>> seen_;
  std::size_t problems_ = 0;
  std::string complaint_;
};

}  // namespace

std::string to_text(const SelectionTable& table) {
  std::string text;
  for (const std::string_view name : {kSelection, std::string_view("View"), kChannel, kBegin, kEnd, kLow, kHigh, kFile, kOffset})
    text += std::string(text.empty() ? "" : "\t") + std::string(name);
  for (const std::string& name : table.columns) text += "\t" + one_cell(name);
  text += '\n';
  std::size_t number = 0;
  for (const Selection& s : table.selections) {
    text += std::to_string(++number) + "\tSpectrogram 1\t" + std::to_string(s.channel) + "\t" + fixed(s.begin_s, 6) + "\t" +
            fixed(s.end_s, 6) + "\t" + fixed(s.low_hz, 3) + "\t" + fixed(s.high_hz, 3) + "\t" + one_cell(s.begin_file) + "\t" +
            fixed(s.file_offset_s, 6);
    for (const std::string& value : s.values) text += "\t" + one_cell(value);
    text += '\n';
  }
  return text;
}

SelectionTable read_selection_table(const std::filesystem::path& path) {
  return selection_table_from(host::read_text(path, kTableFile), path.string());
}

SelectionTable selection_table_from(std::string_view text, const std::string& name) {
  return TableParser(text, name).parse();
}

}  // namespace earshot::annotation
