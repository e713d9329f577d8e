#include "policy/report/document/flight_reading.hpp"

#include <utility>

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

/// Of a folder its own name; of one of several journals that of its file.
std::string name_of(const fs::path& folder_or_journal) {
  const fs::path whole = fs::absolute(folder_or_journal).lexically_normal();
  return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
}

}  // namespace

FlightSurroundings surroundings_of(const fs::path& folder_or_journal) {
  return {.name = name_of(folder_or_journal),
          .journal = journal_of_flight(folder_or_journal),
          .files = read_flight_files(folder_or_journal),
          .recording = {}};
}

std::unique_ptr<GrowingFlight> read_to_its_end(FlightSurroundings surroundings) {
  journal::RecordSource source(surroundings.journal);
  auto flight = std::make_unique<GrowingFlight>(std::move(surroundings));
  while (const std::optional<journal::Entry> entry = source.next()) flight->take(*entry);
  flight->end(source);
  return flight;
}

}  // namespace earshot::report
