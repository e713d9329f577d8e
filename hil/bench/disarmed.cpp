#include "hil/bench/disarmed.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "firmware/safety/supervisor.hpp"

namespace earshot::hil {
namespace {

using config::Condition;

constexpr std::string_view kRule = "[[rule]]";

/// The key of a limit that a rule of every mission has, and a much larger one that a mission may say.
struct Limit {
  Condition rule;
  std::string_view key;
  std::string_view larger;
};
constexpr Limit kLimits[]{{Condition::kNavigationAge, "navigation_timeout_s", "60.0"},
                          {Condition::kNavigationFrozen, "navigation_timeout_s", "60.0"},
                          {Condition::kSnrAge, "snr_timeout_s", "60.0"},
                          {Condition::kDepth, "max_depth_m", "1000.0"}};

/// A line of `key = value # comment`, with another value.
std::string with_value(const std::string& line, std::string_view key, std::string_view value) {
  return line.starts_with(std::string(key) + " =") ? std::string(key) + " = " + std::string(value) : line;
}

/// A line that names a file, which then is found from anywhere.
std::string with_whole_path(const std::string& line, const std::filesystem::path& folder) {
  for (const std::string_view key : {"file", "public_key_file", "tables"}) {
    const std::string begin = std::string(key) + " = \"";
    const std::size_t end = line.find('"', begin.size());
    if (!line.starts_with(begin) || end == std::string::npos) continue;
    const std::filesystem::path named = std::filesystem::absolute(folder / line.substr(begin.size(), end - begin.size()));
    return begin + named.lexically_normal().string() + line.substr(end);
  }
  return line;
}

/// "when = "leak"" in one of the lines that belong to a rule.
bool watches(const std::string& block, Condition rule) {
  return block.find("when = \"" + key_of(rule) + "\"") != std::string::npos;
}

}  // namespace

Expectation expected_without_firing(Expectation expected, const std::vector<Condition>& rules, const config::Mission& mission) {
  const safety::Rules all = safety::rules_of(mission);
  const bool does_more_than_warn = std::ranges::any_of(all, [&rules](const config::Rule& rule) {
    return rule.response != config::Response::kWarn && std::ranges::find(rules, rule.condition) != rules.end();
  });
  if (!does_more_than_warn) return expected;
  expected.rules.clear();
  expected.only_these = false;
  return expected;
}

bool can_be_disarmed(Condition rule) {
  constexpr Condition kStanding[]{Condition::kOutsideHalt,        Condition::kSearchTime,       Condition::kNavigationJump,
                                  Condition::kNoProgress,         Condition::kPolicyUnhealthy,  Condition::kOutsideFence,
                                  Condition::kNavigationDisputed, Condition::kPlaceUnexplained, Condition::kDepthUnexplained,
                                  Condition::kSetpointsUnsent};
  return std::ranges::find(kStanding, rule) == std::end(kStanding);
}

std::string disarmed(const std::string& text, const std::vector<Condition>& rules, const std::filesystem::path& folder) {
  std::string kept;
  std::string block;
  const auto keep_block = [&] {
    const bool is_dropped = block.starts_with(kRule) && std::ranges::any_of(rules, [&](Condition rule) { return watches(block, rule); });
    if (!is_dropped) kept += block;
    block.clear();
  };
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) keep_block();
    for (const Limit& limit : kLimits) {
      if (std::ranges::find(rules, limit.rule) != rules.end()) line = with_value(line, limit.key, limit.larger);
    }
    block += with_whole_path(line, folder) + "\n";
  }
  keep_block();
  return kept;
}

}  // namespace earshot::hil
