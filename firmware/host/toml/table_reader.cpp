#include "firmware/host/toml/table_reader.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/toml/nesting.hpp"

namespace earshot::host {

namespace {

/// As it was written, or as short as it can be and still be the same number: 0.4, not 0.40000000000000002; with a point, as TOML has it.
std::string toml_digits(double number) {
  std::array<char, 32> text{};
  // Left alone, to_chars writes 100000 as 1e+05.
  const double size = std::abs(number);
  const bool is_plain = number == 0.0 || (size >= 1e-4 && size < 1e10);
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, is_plain ? std::chars_format::fixed : std::chars_format::general).ptr;
  const std::string digits(text.data(), end);
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

}  // namespace

struct Problems {
  static constexpr std::size_t kMostLines = 20;        // a screen
  static constexpr std::size_t kLongestProblem = 700;  // bytes: our own words are shorter, and a name may have as many as the file

  std::filesystem::path path;
  std::vector<std::string> lines;
  std::size_t left_out = 0;

  void add(std::size_t line, const std::string& what) {
    if (lines.size() == kMostLines) {
      ++left_out;
      return;
    }
    std::string text = host::printable(path.string());
    if (line > 0) text.append(":").append(std::to_string(line));
    text.append(": ").append(host::printable(shortened(what, kLongestProblem)));
    lines.push_back(text);
  }

  [[nodiscard]] std::string all_in_one() const {
    std::string all;
    for (const std::string& line : lines) all += (all.empty() ? "" : "\n") + line;
    if (left_out > 0) all += "\n" + host::printable(path.string()) + ": " + std::to_string(left_out) + " more problems";
    return all;
  }
};

struct TableNode {
  std::shared_ptr<Problems> problems;
  std::shared_ptr<const toml::table> document;  ///< keeps every node alive
  const toml::table* table = nullptr;           ///< null: the table is missing, which is noted already
  std::string prefix;                           ///< of its keys: "" at the root, "search.", "port 1: " of a table of an array
  std::set<std::string, std::less<>> asked;
  std::set<std::string, std::less<>> noted;  ///< keys with a problem
  std::vector<std::shared_ptr<TableNode>> children;

  /// "search.speed_mps"; of the tables of an array, which are counted as ports are everywhere, "port 1: url".
  [[nodiscard]] std::string full(std::string_view key) const { return prefix + std::string(key); }

  [[nodiscard]] std::size_t line() const { return table != nullptr ? table->source().begin.line : 0; }

  const toml::node* find(std::string_view key) {
    asked.emplace(key);
    return table != nullptr ? table->get(key) : nullptr;
  }

  std::shared_ptr<TableNode> add_child(const toml::table* child, std::string prefix_of_child) {
    auto node = std::make_shared<TableNode>();
    node->problems = problems;
    node->document = document;
    node->table = child;
    node->prefix = std::move(prefix_of_child);
    children.push_back(node);
    return node;
  }

  void note_missing(std::string_view key, const std::string& allowed) {
    noted.emplace(key);
    if (table != nullptr) problems->add(line(), full(key) + " is missing: " + allowed);
  }

  void note_value(std::string_view key, const toml::node& value, const std::string& allowed) {
    noted.emplace(key.substr(0, key.find_first_of("[ ")));  // an element's problem is its array's
    std::ostringstream text;
    text << full(key);
    value.visit([&text](const auto& v) {
      using Value = std::remove_cvref_t<decltype(v)>;
      if constexpr (toml::is_floating_point<Value>) {
        text << " = " << toml_digits(*v);
      } else if constexpr (!toml::is_table<Value> && !toml::is_array<Value>) {
        text << " = " << v;
      }
    });
    problems->add(value.source().begin.line, text.str() + ": " + allowed);
  }

  void note_unknown_keys() const {
    if (table != nullptr) {
      for (const auto& [key, value] : *table) {
        if (!asked.contains(key.str())) problems->add(value.source().begin.line, full(key.str()) + ": unknown key");
      }
    }
    for (const auto& child : children) child->note_unknown_keys();
  }
};

namespace {

constexpr const char* kText = "must be a text of at least one character";

std::string requirement(std::int64_t lowest, std::int64_t highest) {
  return "must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
}

std::string requirement(const std::vector<std::string>& allowed) {
  std::string text = "must be one of";
  for (std::size_t i = 0; i < allowed.size(); ++i) text += (i == 0 ? " \"" : ", \"") + allowed[i] + "\"";
  return text;
}

/// A value inside the range, so that code after a noted problem meets no nonsense.
double harmless(const Range& range) {
  if (std::isfinite(range.highest)) return range.highest;
  return std::isfinite(range.lowest) ? range.lowest + 1.0 : 0.0;
}

std::optional<double> as_number(const toml::node& node) {
  return node.is_number() ? node.value<double>() : std::nullopt;
}

}  // namespace

TableReader::TableReader(std::shared_ptr<TableNode> node) : node_(std::move(node)) {}

bool TableReader::has(std::string_view key) const {
  return node_->table != nullptr && node_->table->contains(key);
}

std::string TableReader::place_of(std::string_view key) const {
  const toml::node* node = node_->table != nullptr ? node_->table->get(key) : nullptr;
  const std::size_t line = node != nullptr ? node->source().begin.line : node_->line();
  return host::printable(node_->problems->path.string()) + ":" + std::to_string(line) + ": " + node_->full(key);
}

bool TableReader::is_noted(std::string_view key) const {
  return node_->noted.contains(key);
}

double TableReader::number(std::string_view key, Range range) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, to_string(range));
    return harmless(range);
  }
  const std::optional<double> value = as_number(*node);
  if (value && range.allows(*value)) return *value;
  node_->note_value(key, *node, to_string(range));
  return harmless(range);
}

double TableReader::number_or(std::string_view key, double fallback, Range range) {
  return node_->find(key) == nullptr ? fallback : number(key, range);
}

std::int64_t TableReader::integer(std::string_view key, std::int64_t lowest, std::int64_t highest) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, requirement(lowest, highest));
    return lowest;
  }
  const std::optional<std::int64_t> value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (value && *value >= lowest && *value <= highest) return *value;
  node_->note_value(key, *node, requirement(lowest, highest));
  return lowest;
}

std::int64_t TableReader::integer_or(std::string_view key, std::int64_t fallback, std::int64_t lowest, std::int64_t highest) {
  return node_->find(key) == nullptr ? fallback : integer(key, lowest, highest);
}

bool TableReader::boolean_or(std::string_view key, bool fallback) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) return fallback;
  if (node->is_boolean()) return *node->value<bool>();
  node_->note_value(key, *node, "must be true or false");
  return fallback;
}

std::string TableReader::text(std::string_view key) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, kText);
    return {};
  }
  if (node->is_string() && !node->value<std::string>()->empty()) return *node->value<std::string>();
  node_->note_value(key, *node, kText);
  return {};
}

std::string TableReader::text_or(std::string_view key, std::string_view fallback) {
  return node_->find(key) == nullptr ? std::string(fallback) : text(key);
}

std::size_t TableReader::choice(std::string_view key, const std::vector<std::string>& allowed) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, requirement(allowed));
    return 0;
  }
  if (node->is_string()) {
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if (*node->value<std::string>() == allowed[i]) return i;
    }
  }
  node_->note_value(key, *node, requirement(allowed));
  return 0;
}

std::size_t TableReader::choice_or(std::string_view key, std::size_t fallback, const std::vector<std::string>& allowed) {
  return node_->find(key) == nullptr ? fallback : choice(key, allowed);
}

std::vector<std::size_t> TableReader::choices(std::string_view key, const std::vector<std::string>& allowed) {
  const std::string wanted = requirement(allowed) + ", or several of them in an array, each once";
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, wanted);
    return {0};
  }
  std::vector<std::size_t> indices;
  if (node->is_array()) {
    for (const toml::node& element : *node->as_array()) {
      const auto found = std::find(allowed.begin(), allowed.end(), element.is_string() ? *element.value<std::string>() : std::string());
      const auto index = static_cast<std::size_t>(found - allowed.begin());
      if (found != allowed.end() && std::find(indices.begin(), indices.end(), index) == indices.end()) indices.push_back(index);
    }
    if (!indices.empty() && indices.size() == node->as_array()->size()) return indices;
  }
  node_->note_value(key, *node, wanted);
  return {0};
}

std::vector<double> TableReader::numbers(std::string_view key, Range range) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, "must be an array of numbers");
    return {};
  }
  if (!node->is_array()) {
    node_->note_value(key, *node, "must be an array of numbers");
    return {};
  }
  std::vector<double> values;
  std::size_t index = 0;
  for (const toml::node& element : *node->as_array()) {
    const std::optional<double> value = as_number(element);
    if (!value || !range.allows(*value)) node_->note_value(std::string(key) + "[" + std::to_string(index) + "]", element, to_string(range));
    values.push_back(value && range.allows(*value) ? *value : harmless(range));
    ++index;
  }
  return values;
}

std::vector<std::string> TableReader::texts(std::string_view key) {
  const char* const wanted = "must be an array of texts";
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, wanted);
    return {};
  }
  if (!node->is_array()) {
    node_->note_value(key, *node, wanted);
    return {};
  }
  std::vector<std::string> values;
  std::size_t index = 0;
  for (const toml::node& element : *node->as_array()) {
    const std::string name = std::string(key) + "[" + std::to_string(index++) + "]";
    values.push_back(element.value<std::string>().value_or(""));
    if (!element.is_string() || values.back().empty()) node_->note_value(name, element, kText);
  }
  return values;
}

TableReader TableReader::table(std::string_view key) {
  const toml::node* node = node_->find(key);
  if (node == nullptr) {
    node_->note_missing(key, "must be a table");
  } else if (!node->is_table()) {
    node_->note_value(key, *node, "must be a table");
  }
  return TableReader(node_->add_child(node != nullptr ? node->as_table() : nullptr, node_->full(key) + "."));
}

std::optional<TableReader> TableReader::optional_table(std::string_view key) {
  if (node_->find(key) == nullptr) return std::nullopt;
  return table(key);
}

std::vector<TableReader> TableReader::tables(std::string_view key, std::size_t most, Counted counted) {
  const toml::node* node = node_->find(key);
  std::vector<TableReader> readers;
  if (node == nullptr) {
    node_->note_missing(key, "must be an array of tables");
    return readers;
  }
  if (!node->is_array()) {
    node_->note_value(key, *node, "must be an array of tables");
    return readers;
  }
  if (const std::size_t there = node->as_array()->size(); there > most)
    node_->note_value(key, *node, "has " + std::to_string(there) + " tables, must have at most " + std::to_string(most));
  std::size_t index = 0;
  for (const toml::node& element : *node->as_array()) {
    if (index == most) break;
    const std::string number = std::to_string(++index);
    const std::string name =
        counted == Counted::kInFile ? "[[" + std::string(key) + "]] number " + number + " of the file" : std::string(key) + " " + number;
    if (!element.is_table()) node_->note_value(name, element, "must be a table");
    readers.push_back(TableReader(node_->add_child(element.as_table(), node_->full(name) + ": ")));
  }
  return readers;
}

void TableReader::problem(std::string_view key, std::string_view what) {
  const toml::node* node = node_->table != nullptr ? node_->table->get(key) : nullptr;
  if (node != nullptr) {
    node_->note_value(key, *node, std::string(what));
  } else {
    node_->noted.emplace(key);
    node_->problems->add(node_->line(), node_->full(key) + ": " + std::string(what));
  }
}

TomlFile::TomlFile(std::filesystem::path path) : TomlFile(path, host::read_text(path, host::kTomlFile)) {}

TomlFile::TomlFile(std::filesystem::path path, const std::string& text)
    : path_(std::move(path)), problems_(std::make_shared<Problems>()), root_(std::make_shared<TableNode>()) {
  problems_->path = path_;
  const auto refused = [this](std::size_t line, const std::string& what) {
    return BadInput(host::printable(path_.string()) + ":" + std::to_string(line) + ": " + what);
  };
  if (const auto line = line_nested_too_deep(text))
    throw refused(*line, "tables, arrays or dots of a key stand more than " + std::to_string(kDeepestNesting) + " deep in each other");
  try {
    root_->document = std::make_shared<const toml::table>(toml::parse(text, path_.string()));
  } catch (const toml::parse_error& e) {
    throw refused(e.source().begin.line, "not TOML: " + host::printable(e.description()));
  }
  root_->problems = problems_;
  root_->table = root_->document.get();
}

TableReader TomlFile::root() const {
  return TableReader(root_);
}

std::filesystem::path TomlFile::resolve(const std::filesystem::path& relative) const {
  return relative.is_absolute() ? relative : (path_.parent_path() / relative).lexically_normal();
}

void TomlFile::finish() const {
  root_->note_unknown_keys();
  if (problems_->lines.empty()) return;
  throw BadInput(problems_->all_in_one());
}

}  // namespace earshot::host
