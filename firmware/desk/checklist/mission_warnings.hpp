#pragma once

#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"

namespace earshot::board {

/// What is allowed and still worth a thought before the dive, one line each. Of a mission that has been read and judged.
[[nodiscard]] std::vector<std::string> mission_warnings(const host::MissionFile& file);

}  // namespace earshot::board
