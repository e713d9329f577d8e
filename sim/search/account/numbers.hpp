#pragma once

#include <string>

namespace earshot::search {

/// "38.500 N, 28.000 W"
/// @param degrees  what stands behind each number, before its direction
[[nodiscard]] std::string geographic(double latitude_deg, double longitude_deg, const std::string& degrees = "");

}  // namespace earshot::search
