#pragma once

#include <string>

namespace earshot::host {

/// "90 s", "47 min", "13 h 05 min": rounded to seconds below two minutes, and else to minutes.
[[nodiscard]] std::string duration(double seconds);

}  // namespace earshot::host
