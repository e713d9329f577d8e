#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "firmware/core/geometry.hpp"

namespace earshot::report {

// How the numbers of a flight's page are written: no more digits than are known, for every page carries them.

/// To so many decimals; a whole number without any. null: it is no number.
[[nodiscard]] nlohmann::ordered_json rounded(double x, int decimals);
/// Degrees clockwise from north, 0 to below 360, to a tenth. @param degrees  likewise
[[nodiscard]] nlohmann::ordered_json rounded_compass(double degrees);
[[nodiscard]] nlohmann::ordered_json compass_value(Radians direction);
/// To the decimetre.
[[nodiscard]] nlohmann::ordered_json place_value(NorthEast place);
/// On one line. What is not UTF-8 is replaced: the name of a folder may be any bytes.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

}  // namespace earshot::report
