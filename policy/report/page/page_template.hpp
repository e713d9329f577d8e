#pragma once

#include <string>
#include <string_view>

namespace earshot::report {

/// The page of a flight without the flight: it asks `events` beside it for one that is under way (policy/watch).
[[nodiscard]] std::string_view page_template();

/// The page with a flight in it, which needs no other file.
/// @param flight  JSON, as source/flight.ts describes it. Compressed (gzip) where it is long.
[[nodiscard]] std::string page_with(std::string_view flight);

}  // namespace earshot::report
