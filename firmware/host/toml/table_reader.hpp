#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"

namespace earshot::host {

struct Problems;   ///< what the readers of one file have found so far
struct TableNode;  ///< one TOML table and which of its keys were asked for

/// Reads the keys of one TOML table. A bad, missing or unknown key is noted, a harmless value is returned, and reading goes on, so that
/// `TomlFile::finish` can report every problem at once. Numbers must be finite. Each key names its unit ("depth_m").
class TableReader {
 public:
  static constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);
  /// What the number of a table of an array is good for, and how a problem names it.
  enum class Counted : std::uint8_t {
    kEverywhere,  ///< "port 1: url"
    kInFile,      ///< "[[rule]] number 1 of the file: above", where elsewhere another count goes by the name
  };

  [[nodiscard]] double number(std::string_view key, Range range = {});
  [[nodiscard]] double number_or(std::string_view key, double fallback, Range range = {});
  [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t lowest, std::int64_t highest);
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t fallback, std::int64_t lowest, std::int64_t highest);
  [[nodiscard]] bool boolean_or(std::string_view key, bool fallback);
  [[nodiscard]] std::string text(std::string_view key);  ///< at least one character
  [[nodiscard]] std::string text_or(std::string_view key, std::string_view fallback);
  /// One of the allowed words; returns its index.
  [[nodiscard]] std::size_t choice(std::string_view key, const std::vector<std::string>& allowed);
  [[nodiscard]] std::size_t choice_or(std::string_view key, std::size_t fallback, const std::vector<std::string>& allowed);
  /// An array of allowed words, each at most once and at least one; returns their indices.
  [[nodiscard]] std::vector<std::size_t> choices(std::string_view key, const std::vector<std::string>& allowed);
  /// An array of numbers, each within `range`.
  [[nodiscard]] std::vector<double> numbers(std::string_view key, Range range = {});
  /// An array of texts, each of at least one character.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key);
  [[nodiscard]] bool has(std::string_view key) const;

  /// The table under `key`; a missing one is noted and reads as empty.
  [[nodiscard]] TableReader table(std::string_view key);
  [[nodiscard]] std::optional<TableReader> optional_table(std::string_view key);
  /// Each table of an array of tables. Of more than `most` the number is noted, and the first `most` are given.
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key, std::size_t most = kAnyNumber,
                                                Counted counted = Counted::kEverywhere);

  /// Where a key stands that is there, for what turns out wrong after reading: "mission.toml:31: policy.file".
  [[nodiscard]] std::string place_of(std::string_view key) const;

  /// Notes a problem of the caller's own finding about `key` ("must be less than max_depth_m").
  void problem(std::string_view key, std::string_view what);
  /// Whether a problem of this key is noted already: what was read for it is then harmless, but not what the file says, and a complaint
  /// about how it fits the rest would be false.
  [[nodiscard]] bool is_noted(std::string_view key) const;

 private:
  friend class TomlFile;
  explicit TableReader(std::shared_ptr<TableNode> node);
  std::shared_ptr<TableNode> node_;
};

/// One TOML file.
///
///     host::TomlFile file{"mission.toml"};
///     TableReader root = file.root();
///     mission.depth = Meters{root.number("depth_m", Range::above(0))};
///     file.finish();   // throws BadInput with every problem, unknown keys included
class TomlFile {
 public:
  /// Throws BadInput when the file cannot be read or is not TOML.
  explicit TomlFile(std::filesystem::path path);
  /// Of text that has been read from `path`.
  TomlFile(std::filesystem::path path, const std::string& text);
  [[nodiscard]] TableReader root() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// `relative` as written in this file: relative paths are relative to the file's own folder.
  [[nodiscard]] std::filesystem::path resolve(const std::filesystem::path& relative) const;
  /// Throws BadInput if anything was noted or a key was never asked for.
  void finish() const;

 private:
  std::filesystem::path path_;
  std::shared_ptr<Problems> problems_;
  std::shared_ptr<TableNode> root_;
};

}  // namespace earshot::host
