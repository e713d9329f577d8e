#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/host/program/talk.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace earshot::program {

/// Where the value of an option goes; what stands there before is its default. A function reads the value itself, and throws
/// host::BadInput when it cannot.
using Target =
    std::variant<std::string*, std::filesystem::path*, double*, std::uint64_t*, std::uint32_t*, std::optional<std::string>*,
                 std::optional<std::filesystem::path>*, std::optional<double>*, std::optional<std::uint64_t>*,
                 std::optional<std::uint32_t>*, std::vector<std::string>*, std::vector<double>*, std::function<void(const std::string&)>>;

/// What may be said about one option after it was declared. Its checks are made before anything is done with a value; none of them lets a
/// NaN pass.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  /// Help says what stands in the target now.
  Option& shows_default();
  /// A number between both, or one of them.
  Option& between(double lowest, double highest);
  /// A whole number from lowest to highest.
  Option& from(std::int64_t lowest, std::int64_t highest);
  /// A number greater than zero.
  Option& positive();
  /// Zero or a number greater than that.
  Option& not_negative();
  Option& one_of(std::vector<std::string> words);
  /// The last check that is asked for is the first that is made; what the target can hold is checked last: it says least.
  /// @param complaint  what is wrong with a value, in words; empty when nothing is
  /// @param allowed    what help says of its values
  Option& checked(std::function<std::string(const std::string& value)> complaint, const std::string& allowed = {});
  /// So many values follow; -1: as many as there are.
  Option& takes(int least, int most);
  /// Several values, one each time that it is given: what follows that one is another's.
  Option& one_each_time();
  /// Says what the word, which is never the empty one, names. @param what  "a file"
  Option& names(const std::string& what);
  Option& separated_by(char delimiter);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// The options of one program, or of one of its verbs. Every program has --help, --version, --quiet and --verbose.
/// Oracle: CommandLine.* in tests/firmware/host/program
class CommandLine {
 public:
  /// @param name  as a person types it, "earshot field"
  CommandLine(const std::string& name, const std::string& what);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// A text or a path is never the empty word.
  /// @param names  "--out", "-o,--output", or without a dash for a value that stands alone
  Option option(const std::string& names, Target target, const std::string& what);
  Option flag(const std::string& names, bool* target, const std::string& what);
  /// One that was declared before.
  [[nodiscard]] Option at(const std::string& name) const;
  /// What help ends with: examples.
  void footer(const std::string& text);

  /// `earshot explain map`: a word with options of its own. One of a program's verbs must be given.
  CommandLine& verb(const std::string& name, const std::string& what);
  [[nodiscard]] bool is_chosen() const;

  /// Reads what follows the program's name.
  /// @return the answer to --help or --version, when one of them is asked for
  /// @throws host::BadInput with one message about what is wrong
  std::optional<std::string> read(const std::vector<std::string>& arguments);
  std::optional<std::string> read(int argc, const char* const* argv);

  /// The options that were given, by their long names, those that every program has apart.
  [[nodiscard]] std::vector<std::string> given() const;
  /// The options that were given or have a default, those of the chosen verb too, a line each: "  --terms 8 (default)".
  [[nodiscard]] std::string settings() const;
  [[nodiscard]] Talk talk() const;
  [[nodiscard]] std::string name() const;

 private:
  explicit CommandLine(CLI::App& verb);
  [[nodiscard]] std::string complaint_about_unknown() const;

  std::unique_ptr<CLI::App> own_;  ///< of a program; none for a verb, which its program's holds
  CLI::App* app_;
  std::vector<std::unique_ptr<CommandLine>> verbs_;
  bool quiet_ = false;
  bool verbose_ = false;
};

/// A number that is neither infinite nor a NaN, written out in `text` and nothing behind it.
[[nodiscard]] std::optional<double> finite_number(std::string text);

/// A whole number written out in `text` and nothing else.
[[nodiscard]] std::optional<std::int64_t> whole_number(const std::string& text);

/// The command line as a person would type it again.
[[nodiscard]] std::string as_typed(int argc, const char* const* argv);

/// What --version says: "earshotd 0.2.0 (commit be0db8b3ee7314c307930a3fdb09bf5aae68edde, clean tree)".
[[nodiscard]] std::string version_line(std::string_view program);

/// The same of any commit (version.hpp).
[[nodiscard]] std::string version_line(std::string_view program, std::string_view version, std::string_view commit);

}  // namespace earshot::program
