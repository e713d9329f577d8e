#include "firmware/host/program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <type_traits>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/suggestion.hpp"
#include "firmware/host/program/version.hpp"

namespace earshot::program {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool is_general(const std::string& option) {
  return option == "--help" || option == "--version" || option == "--quiet" || option == "--verbose";
}

/// CLI11's own takes the greatest there is for one that is greater.
template <class Value>
std::optional<Value> whole_number_as(const std::string& text) {
  Value value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// What a variable of a script that is not set becomes. An option that is left out says the same, and means it.
template <class Value>
void refuse_what_does_not_fit(CLI::Option& option, const Value*) {
  if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, std::filesystem::path>) {
    option.check([](const std::string& text) { return std::string(text.empty() ? "must not be the empty word" : ""); });
  } else if constexpr (std::is_unsigned_v<Value>) {
    option.check([](const std::string& text) {
      if (whole_number_as<Value>(text)) return std::string();
      return text + ": must be a whole number from 0 to " + std::to_string(std::numeric_limits<Value>::max());
    });
  }
}

template <class Value>
void refuse_what_does_not_fit(CLI::Option& option, const std::optional<Value>*) {
  refuse_what_does_not_fit(option, static_cast<const Value*>(nullptr));
}

template <class Value>
void refuse_what_does_not_fit(CLI::Option& option, const std::vector<Value>*) {
  refuse_what_does_not_fit(option, static_cast<const Value*>(nullptr));
}

/// Hands CLI11 a target of any type.
struct Declare {
  CLI::App& app;
  const std::string& names;
  const std::string& what;
  CLI::Option& operator()(const std::function<void(const std::string&)>& read) const {
    return *app.add_option_function<std::string>(names, read, what);
  }
  template <class Value>
  CLI::Option& operator()(Value* value) const {
    CLI::Option& option = *app.add_option(names, *value, what);
    refuse_what_does_not_fit(option, value);
    return option;
  }
};

std::vector<std::string> long_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::between(double lowest, double highest) {
  std::ostringstream range;
  range << lowest << " to " << highest;
  const auto complaint = [lowest, highest, allowed = range.str()](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value >= lowest && *value <= highest ? std::string() : text + ": must be a number from " + allowed;
  };
  return checked(complaint, range.str());
}

Option& Option::from(std::int64_t lowest, std::int64_t highest) {
  const std::string allowed = std::to_string(lowest) + " to " + std::to_string(highest);
  const auto complaint = [lowest, highest, allowed](const std::string& text) {
    const std::optional<std::int64_t> value = whole_number(text);
    return value && *value >= lowest && *value <= highest ? std::string() : text + ": must be a whole number from " + allowed;
  };
  return checked(complaint, allowed);
}

Option& Option::positive() {
  const auto complaint = [](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value > 0.0 ? std::string() : text + ": must be a number greater than 0";
  };
  return checked(complaint, "greater than 0");
}

Option& Option::not_negative() {
  const auto complaint = [](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value >= 0.0 ? std::string() : text + ": must be 0 or a greater number";
  };
  return checked(complaint, "0 or greater");
}

Option& Option::one_of(std::vector<std::string> words) {
  const std::string allowed = "{" + joined(words, ",") + "}";
  const auto complaint = [words = std::move(words)](const std::string& text) {
    if (std::ranges::find(words, text) != words.end()) return std::string();
    return text + ": must be one of " + joined(words, ", ") + did_you_mean(text, words);
  };
  return checked(complaint, allowed);
}

Option& Option::checked(std::function<std::string(const std::string&)> complaint, const std::string& allowed) {
  // transform() is a check() before the others.
  option_->transform(CLI::Validator([complaint = std::move(complaint)](std::string& text) { return complaint(text); }, allowed));
  return *this;
}

Option& Option::takes(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Option& Option::one_each_time() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::names(const std::string& what) {
  return checked([what](const std::string& text) { return std::string(text.empty() ? "must name " + what : ""); });
}

Option& Option::separated_by(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

CommandLine::CommandLine(const std::string& name, const std::string& what)
    : own_(std::make_unique<CLI::App>(what, name)), app_(own_.get()) {
  app_->set_version_flag("--version", version_line(name),
                         "Print the version, the commit that it was built from and whether the tree was clean, and exit");
  const Option quiet = flag("--quiet", &quiet_, "print nothing but what is wrong");
  flag("--verbose", &verbose_, "also print what goes into the work: settings, files, steps").excludes(quiet);
}

CommandLine::CommandLine(CLI::App& verb) : app_(&verb) {}

CommandLine::~CommandLine() = default;

Option CommandLine::option(const std::string& names, Target target, const std::string& what) {
  return Option(std::visit(Declare{*app_, names, what}, target));
}

Option CommandLine::flag(const std::string& names, bool* target, const std::string& what) {
  return Option(*app_->add_flag(names, *target, what));
}

Option CommandLine::at(const std::string& name) const {
  return Option(*app_->get_option(name));
}

void CommandLine::footer(const std::string& text) {
  app_->footer(text);
}

CommandLine& CommandLine::verb(const std::string& name, const std::string& what) {
  CLI::App* verb = app_->add_subcommand(name, what);
  verb->fallthrough();
  app_->require_subcommand(1);
  verbs_.push_back(std::unique_ptr<CommandLine>(new CommandLine(*verb)));
  return *verbs_.back();
}

bool CommandLine::is_chosen() const {
  return app_->parsed();
}

/// The first word that is no option of ours; empty when all are.
std::string CommandLine::complaint_about_unknown() const {
  const std::vector<std::string> words = app_->remaining(true);
  const auto is_option = [](const std::string& word) { return word.size() > 1 && word.front() == '-'; };
  std::vector<std::string> known = long_names(*app_);
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app_->get_subcommands(nullptr)) {
    verbs.push_back(verb->get_name());
    if (verb->parsed()) std::ranges::copy(long_names(*verb), std::back_inserter(known));
  }
  if (const auto word = std::ranges::find_if(words, is_option); word != words.end()) {
    const std::string option = word->substr(0, word->find('='));
    return option + ": no such option" + did_you_mean(option, known);
  }
  if (words.empty()) return {};
  const bool lacks_verb = !verbs.empty() && app_->get_subcommands().empty();
  return words.back() + (lacks_verb ? ": no such verb" + did_you_mean(words.back(), verbs) : ": one value too many");
}

std::optional<std::string> CommandLine::read(const std::vector<std::string>& arguments) {
  // As CLI11 wants them.
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app_->parse(reversed);
    return std::nullopt;
  } catch (const CLI::CallForVersion&) {
    return version_line(name()) + "\n";
  } catch (const CLI::Success&) {
    return app_->help();
  } catch (const CLI::ParseError& e) {
    const std::string unknown = complaint_about_unknown();
    throw host::BadInput(name() + ": " + (unknown.empty() ? e.what() : unknown) + " (" + name() + " --help lists all)");
  }
}

std::optional<std::string> CommandLine::read(int argc, const char* const* argv) {
  return read(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}

std::vector<std::string> CommandLine::given() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() > 0 && !is_general(option->get_name())) names.push_back(option->get_name());
  }
  return names;
}

std::string CommandLine::settings() const {
  std::string lines;
  for (const CLI::Option* option : app_->get_options()) {
    if (is_general(option->get_name())) continue;
    if (option->count() > 0)
      lines += "  " + option->get_name() + " " + joined(option->results(), " ") + "\n";
    else if (!option->get_default_str().empty())
      lines += "  " + option->get_name() + " " + option->get_default_str() + " (default)\n";
  }
  for (const std::unique_ptr<CommandLine>& verb : verbs_) {
    if (verb->is_chosen()) lines += "  " + verb->name() + "\n" + verb->settings();
  }
  return lines;
}

Talk CommandLine::talk() const {
  if (quiet_) return Talk::kQuiet;
  return verbose_ ? Talk::kVerbose : Talk::kNormal;
}

std::string CommandLine::name() const {
  return app_->get_name();
}

std::string version_line(std::string_view program) {
  return version_line(program, version(), build_commit());
}

std::string version_line(std::string_view program, std::string_view version, std::string_view commit) {
  constexpr std::string_view kChanged = "-dirty";
  const bool is_changed = commit.ends_with(kChanged);
  if (is_changed) commit.remove_suffix(kChanged.size());
  std::string line = std::string(program) + " " + std::string(version) + " (commit " + std::string(commit);
  if (commit != "unknown") line += is_changed ? ", with changes that no commit holds" : ", clean tree";
  return line + ")";
}

std::optional<double> finite_number(std::string text) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> whole_number(const std::string& text) {
  return whole_number_as<std::int64_t>(text);
}

std::string as_typed(int argc, const char* const* argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

}  // namespace earshot::program
