#pragma once

#include <span>
#include <string>

#include "policy/report/flight_files.hpp"

namespace earshot::report {

// What a page says of a flight that only its journal tells of.

/// How it ended and why, and when it was.
[[nodiscard]] std::string sea_headline(const SeaFlight& flight, const JournalledSearch& journal);

/// In numbers.
[[nodiscard]] std::string sea_facts(const SeaFlight& flight, const JournalledSearch& journal);

/// Orders, rules that acted and changes of state, with their times.
[[nodiscard]] std::string events_table(std::span<const SeaFlight::Event> events);

/// The same; what was refused.
[[nodiscard]] std::string sea_events(const SeaFlight& flight);

}  // namespace earshot::report
