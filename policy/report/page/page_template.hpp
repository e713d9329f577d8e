#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace earshot::report {

/// The page of a flight without the flight: it asks `events` beside it for one that is under way (policy/watch).
[[nodiscard]] std::string_view page_template();

enum class PageOf : std::uint8_t {
  kFlight,  ///< source/flight.ts
  kSuite,   ///< of an evaluation: source/suite.ts
  kBench,   ///< of a run of the bench: source/bench.ts
};

/// The page with what it shows in it, which needs no other file.
/// @param json  as its source describes it. Compressed (gzip) where it is long.
[[nodiscard]] std::string page_with(std::string_view json, PageOf what = PageOf::kFlight);

/// RFC 4648, section 4: how bytes stand in a page.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace earshot::report
