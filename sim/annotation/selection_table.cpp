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
#include "firmware/host/text/numbers.hpp"

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
constexpr std::string_view kDuration = "Duration (s)";

/// What other tables call the columns, in small letters and figures only.
struct Alias {
  std::string_view name;
  std::string_view column;
};
constexpr std::array kAliases{Alias{"begintimes", kBegin},
                              Alias{"begintime", kBegin},
                              Alias{"begins", kBegin},
                              Alias{"begin", kBegin},
                              Alias{"starttimes", kBegin},
                              Alias{"starttime", kBegin},
                              Alias{"starts", kBegin},
                              Alias{"start", kBegin},
                              Alias{"onset", kBegin},
                              Alias{"onsets", kBegin},
                              Alias{"endtimes", kEnd},
                              Alias{"endtime", kEnd},
                              Alias{"ends", kEnd},
                              Alias{"end", kEnd},
                              Alias{"stop", kEnd},
                              Alias{"stops", kEnd},
                              Alias{"durations", kDuration},
                              Alias{"duration", kDuration},
                              Alias{"lowfreqhz", kLow},
                              Alias{"lowfreq", kLow},
                              Alias{"lowhz", kLow},
                              Alias{"minfreq", kLow},
                              Alias{"highfreqhz", kHigh},
                              Alias{"highfreq", kHigh},
                              Alias{"highhz", kHigh},
                              Alias{"maxfreq", kHigh},
                              Alias{"beginfile", kFile},
                              Alias{"filename", kFile},
                              Alias{"file", kFile},
                              Alias{"fileoffsets", kOffset},
                              Alias{"fileoffset", kOffset},
                              Alias{"channel", kChannel},
                              Alias{"selection", kSelection},
                              Alias{"beginpath", kFile},
                              Alias{"lowfrequencyhz", kLow},
                              Alias{"highfrequencyhz", kHigh}};

std::string_view column_of(std::string_view header) {
  std::string plain;
  for (const char c : header) {
    if (c >= 'A' && c <= 'Z') plain += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) plain += c;
  }
  for (const std::string_view seconds : {"seconds", "sec"})
    if (plain.ends_with(seconds)) plain.replace(plain.size() - seconds.size(), seconds.size(), "s");
  const auto* const found = std::ranges::find(kAliases, plain, &Alias::name);
  return found == kAliases.end() ? header : found->column;
}

/// A name may hold what parts columns and lines.
std::string one_cell(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// Without the blanks about it, and without the quotation marks that R puts about a whole cell.
std::string bare(std::string_view cell) {
  const std::size_t begin = std::min(cell.find_first_not_of(' '), cell.size());
  cell = cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin);
  const bool is_quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return std::string(is_quoted ? cell.substr(1, cell.size() - 2) : cell);
}

/// @param at  where the cells are parted; between quotation marks it parts nothing, but for tabs
std::vector<std::string> split(std::string_view line, char at) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_mark = line[i] == '"' && at != '\t';
    if (is_mark && is_quoted && line.substr(i + 1).starts_with('"')) {
      cells.back() += line[++i];
    } else if (is_mark && (is_quoted || cells.back().find_first_not_of(' ') == std::string::npos)) {
      is_quoted = !is_quoted;
    } else if (line[i] == at && !is_quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells) cell = bare(cell);
  return cells;
}

std::optional<double> number_of(std::string text, bool has_comma) {
  if (has_comma) std::ranges::replace(text, ',', '.');
  if (text.starts_with('+') && !text.starts_with("+-")) text.erase(0, 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

class TableParser {
 public:
  TableParser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  SelectionTable parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // a byte order mark
    read_header();
    SelectionTable table;
    while (!text_.empty()) {
      cells_ = split(next_line(), separator_);
      if (cells_.size() == 1 && cells_.front().find_first_not_of(' ') == std::string::npos) continue;
      if (problems_ >= kMostProblems) continue;
      if (cells_.front() == "\\" && !table.selections.empty())
        read_frequencies(table.selections.back());
      else
        read_line(table);
    }
    if (problems_ > 0) throw host::BadInput(complaint_);
    return table;
  }

 private:
  std::string_view next_line() {
    ++line_;
    const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
    const std::string_view line = text_.substr(0, end);
    const bool has_both = text_.substr(end).starts_with("\r\n");
    text_.remove_prefix(std::min(end + (has_both ? 2 : 1), text_.size()));
    return line;
  }

  void read_header() {
    const std::string_view all = text_;
    const std::string_view line = next_line();
    for (const char separator : {';', ',', '\t'})
      if (line.find(separator) != std::string_view::npos) separator_ = separator;
    if (separator_ == ',' && line.find(';') != std::string_view::npos) separator_ = ';';
    header_ = split(line, separator_);
    const auto is_number = [this](const std::string& cell) { return number_of(cell, separator_ != ',').has_value(); };
    if (header_.size() >= 2 && is_number(header_[0]) && is_number(header_[1])) {  // as Audacity writes labels
      header_ = {std::string(kBegin), std::string(kEnd)};
      text_ = all;
      line_ = 0;
    }
    for (const std::string& name : header_) columns_.emplace_back(column_of(name));
    const bool has_end = column(kEnd) || column(kDuration);
    if (column(kBegin) && has_end) return;
    throw host::BadInput(
        name_ + ": is no Raven selection table, no CSV of start and end and no labels of Audacity: its first line has no column \"" +
        std::string(column(kBegin) ? kEnd : kBegin) + "\"");
  }

  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const {
    // Raven's own name first: a table may have columns of the user's that are called alike.
    auto found = std::ranges::find(header_, name);
    if (found != header_.end()) return static_cast<std::size_t>(found - header_.begin());
    found = std::ranges::find(columns_, name);
    return found == columns_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - columns_.begin()));
  }

  [[nodiscard]] std::string_view cell(std::string_view name) const {
    const std::optional<std::size_t> at = column(name);
    return at && *at < cells_.size() ? std::string_view(cells_[*at]) : std::string_view();
  }

  [[nodiscard]] std::string_view shown(std::string_view name) const {
    const std::optional<std::size_t> at = column(name);
    return at ? std::string_view(header_[*at]) : name;
  }

  void note(std::string_view column, const std::string& what) {
    if (++problems_ > kMostProblems) return;
    if (!complaint_.empty()) complaint_ += '\n';
    complaint_ += name_ + ":" + std::to_string(line_) + ": " + std::string(shown(column)) + " = " + std::string(cell(column)) + ": " + what;
  }

  double number(std::string_view column, double highest, std::optional<double> otherwise = {}) {
    const std::string_view text = cell(column);
    if (text.empty() && otherwise) return *otherwise;
    const std::optional<double> value = number_of(std::string(text), separator_ != ',');
    if (value && *value >= 0.0 && *value <= highest) return *value;
    note(column, "must be a number from 0 to " + host::decimals(highest, 0));
    return 0.0;
  }

  int channel() {
    const double value = number(kChannel, 1024.0, 1.0);
    if (value != std::floor(value)) note(kChannel, "must be a whole number");
    return static_cast<int>(value);
  }

  /// Audacity's second line of a label that has frequencies; it writes -1 for none.
  void read_frequencies(Selection& selection) const {
    const auto at = [this](std::size_t i) { return i < cells_.size() ? number_of(cells_[i], true).value_or(0.0) : 0.0; };
    selection.low_hz = std::max(at(1), 0.0);
    selection.high_hz = std::max(at(2), 0.0);
  }

  void read_line(SelectionTable& table) {
    const std::size_t before = problems_;
    Selection selection{.begin_s = number(kBegin, kLatest_s),
                        .end_s = 0.0,
                        .low_hz = number(kLow, kHighest_hz, 0.0),
                        .high_hz = number(kHigh, kHighest_hz, 0.0),
                        .channel = channel(),
                        .begin_file = std::string(cell(kFile)),
                        .file_offset_s = number(kOffset, kLatest_s, 0.0),
                        .values = {},
                        .names_channel = !cell(kChannel).empty(),
                        .names_offset = !cell(kOffset).empty()};
    selection.end_s = column(kEnd) ? number(kEnd, kLatest_s) : selection.begin_s + number(kDuration, kLatest_s);
    if (problems_ == before && selection.end_s < selection.begin_s) note(kEnd, "lies before the begin");
    if (problems_ > before) return;
    const std::string order(cell(kSelection));
    const bool is_new =
        order.empty() || seen_.emplace(order, selection.begin_s, selection.end_s, selection.channel, selection.begin_file).second;
    if (is_new) table.selections.push_back(std::move(selection));
  }

  std::string_view text_;
  std::string name_;
  std::size_t line_ = 0;
  char separator_ = '\t';
  std::vector<std::string> header_;
  std::vector<std::string> columns_;  ///< as Raven calls them, where it knows them
  std::vector<std::string> cells_;
  std::set<std::tuple<std::string, double, double, int, std::string>> seen_;
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
    text += std::to_string(++number) + "\tSpectrogram 1\t" + std::to_string(s.channel) + "\t" + host::decimals(s.begin_s, 6) + "\t" +
            host::decimals(s.end_s, 6) + "\t" + host::decimals(s.low_hz, 3) + "\t" + host::decimals(s.high_hz, 3) + "\t" +
            one_cell(s.begin_file) + "\t" + host::decimals(s.file_offset_s, 6);
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
