#pragma once

#include <string>

#include "sim/apps/report/flight_files.hpp"

namespace earshot::report {

/// A page that needs no other file: what happened, the two pictures, every decision.
[[nodiscard]] std::string page(const Flight& flight, const std::string& map, const std::string& history);

}  // namespace earshot::report
