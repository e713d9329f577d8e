#include "policy/description/json_fault.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace earshot::description {
namespace {

// The numbers that the library gives its exceptions (its documentation, "Exceptions").
constexpr int kOtherType = 302;
constexpr int kNoSuchKey = 403;

/// The text between the first `before` and the `after` that ends it.
std::optional<std::string_view> between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string_view::npos) return std::nullopt;
  text.remove_prefix(begin + before.size());
  const std::size_t end = after.empty() ? text.size() : text.rfind(after);
  return end == std::string_view::npos ? std::nullopt : std::optional(text.substr(0, end));
}

/// A JSON type with its article.
std::string_view in_our_words(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWords{{{"null", "nothing"},
                                                                                 {"boolean", "true or false"},
                                                                                 {"number", "a number"},
                                                                                 {"string", "a text"},
                                                                                 {"array", "a list"},
                                                                                 {"object", "a table"}}};
  for (const auto& [theirs, ours] : kWords) {
    if (type == theirs) return ours;
  }
  return "another thing";
}

std::string of_other_type(std::string_view message) {
  const auto wanted = between(message, "type must be ", ", but is ");
  const auto found = between(message, ", but is ", "");
  if (!wanted || !found) return "holds another kind of value than belongs there";
  return "holds " + std::string(in_our_words(*found)) + " where " + std::string(in_our_words(*wanted)) + " belongs";
}

}  // namespace

std::string to_string(const nlohmann::json::exception& fault) {
  if (const auto* parse = dynamic_cast<const nlohmann::json::parse_error*>(&fault))
    return "not JSON from byte " + std::to_string(parse->byte) + " on, or cut short";
  const std::string_view message = fault.what();
  if (fault.id == kOtherType) return of_other_type(message);
  if (const auto key = between(message, "key '", "' not found"); fault.id == kNoSuchKey && key)
    return "has no \"" + std::string(*key) + "\"";
  return "does not hold what belongs there";
}

}  // namespace earshot::description
