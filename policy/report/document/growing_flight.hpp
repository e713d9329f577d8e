#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "policy/report/flight_files.hpp"

namespace earshot::report {

/// What lies beside a flight's journal, and what a person says of it. A vehicle's flight needs none of it but its name: its journal holds
/// the mission, the policy and the tables.
struct FlightSurroundings {
  std::string name;        ///< of the folder or the journal
  nlohmann::json summary;  ///< of a simulator; null: none
  std::vector<SnrRow> snr;
  HeardSound sound;
  std::vector<std::string> missing;             ///< names of files that a simulator should have left
  std::optional<std::filesystem::path> policy;  ///< that flew, instead of the one in the journal
  std::optional<std::filesystem::path> tables;  ///< likewise
  std::optional<NorthEast> south_west;          ///< of the area, instead of the mission's
  std::optional<std::uint32_t> open_at_step;    ///< the decision that a page shows first
};

/// How much of a flight somebody has been told.
struct Told {
  std::size_t turns = 0;
  std::size_t decisions = 0;
  std::size_t events = 0;
  nlohmann::ordered_json others;  ///< all else, as it was told last
};

/// A flight as its page is given it (policy/report/page/source/flight.ts), made of the entries of its journal as they come. A turn costs
/// microseconds; a decision is explained once, when it comes.
class GrowingFlight {
 public:
  static constexpr std::size_t kMostRows = 8'000;

  /// @throws host::BadInput when a policy or tables are named and cannot be read
  explicit GrowingFlight(FlightSurroundings surroundings);
  ~GrowingFlight();
  GrowingFlight(const GrowingFlight&) = delete;
  GrowingFlight& operator=(const GrowingFlight&) = delete;

  void take(const journal::Entry& entry);
  /// The journal has come to its end, and nobody writes it any more: what is missing there is told.
  void end(const journal::RecordSource& source);

  /// A `Flight`. Of more turns than `most_rows` every second, third, ... has a row.
  [[nodiscard]] nlohmann::ordered_json whole(std::size_t most_rows = kMostRows);
  /// A `FlightNews`: what has come since `told`, which is brought up to date. Empty: nothing.
  [[nodiscard]] nlohmann::ordered_json news(Told& told);
  /// What somebody knows who has just been given the whole.
  [[nodiscard]] Told all_told();

  /// Its mission has ended, or its journal.
  [[nodiscard]] bool is_over() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace earshot::report
