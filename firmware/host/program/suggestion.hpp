#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace earshot::program {

/// What somebody who typed `word` may have meant: the known word that is fewest slips away (a letter missing, too many, another, or two
/// exchanged), if those are at most a third of it.
/// Oracle: Suggestion.FindsEachKindOfSlip
[[nodiscard]] std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known);

/// "; did you mean X?", or nothing where nothing is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace earshot::program
