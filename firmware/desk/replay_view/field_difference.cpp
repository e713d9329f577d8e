#include "firmware/desk/replay_view/field_difference.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::replay_view {
namespace {

using Json = nlohmann::ordered_json;

/// By what is printed: a NaN, which is null there, is what a NaN was.
void compare(const std::string& name, const Json& then, const Json& now, std::vector<FieldDifference>& differences) {
  const std::string before = journal::to_line(then);
  const std::string after = journal::to_line(now);
  if (before == after) return;
  if (then.is_object() && now.is_object()) {
    for (const auto& [key, value] : then.items())
      compare(name.empty() ? key : name + "." + key, value, now.value(key, Json()), differences);
  } else if (then.is_array() && now.is_array() && then.size() == now.size()) {
    for (std::size_t i = 0; i < then.size(); ++i) compare(name + "[" + std::to_string(i) + "]", then[i], now[i], differences);
  } else {
    differences.push_back({.field = name, .then = before, .now = after});
  }
}

/// What no field shows: a date, the sign of a zero, a record that cannot be read.
FieldDifference byte_difference(std::span<const std::uint8_t> then, std::span<const std::uint8_t> now) {
  if (then.size() != now.size())
    return {.field = "its length", .then = host::counted(then.size(), "byte"), .now = host::counted(now.size(), "byte")};
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(then, now).in1 - then.begin());
  return {.field = "byte " + std::to_string(at) + " of its message", .then = std::to_string(then[at]), .now = std::to_string(now[at])};
}

}  // namespace

std::vector<FieldDifference> field_differences(std::string_view channel, std::span<const std::uint8_t> then,
                                               std::span<const std::uint8_t> now) {
  std::vector<FieldDifference> differences;
  if (std::ranges::equal(then, now)) return differences;
  compare("", journal::fields_of(journal::decode_record(channel, Time{}, then)),
          journal::fields_of(journal::decode_record(channel, Time{}, now)), differences);
  if (differences.empty() || differences.front().field.empty()) differences = {byte_difference(then, now)};
  return differences;
}

std::string to_string(std::span<const FieldDifference> differences) {
  constexpr std::size_t kMostReported = 4;
  std::string text;
  for (const FieldDifference& d : differences.first(std::min(kMostReported, differences.size())))
    text += (text.empty() ? "" : "; ") + d.field + " is " + d.then + " in the journal, " + d.now + " now";
  if (differences.size() > kMostReported) text += "; and " + host::counted(differences.size() - kMostReported, "field") + " more";
  return text;
}

}  // namespace earshot::replay_view
