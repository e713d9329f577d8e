#pragma once

#include <filesystem>
#include <memory>

#include "policy/report/document/growing_flight.hpp"

namespace earshot::report {

/// What is known of a flight but its journal, which is at journal_of_flight().
/// @throws host::BadInput naming the file that cannot be read.
[[nodiscard]] FlightSurroundings surroundings_of(const std::filesystem::path& folder_or_journal);

/// A flight that is over, read to its journal's end. @throws likewise
[[nodiscard]] std::unique_ptr<GrowingFlight> read_to_its_end(FlightSurroundings surroundings);

}  // namespace earshot::report
