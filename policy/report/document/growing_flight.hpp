#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "policy/report/flight_files.hpp"
#include "policy/report/recorded_flight.hpp"

namespace earshot::report {

/// What lies beside a flight's journal, and what a person says of it. A vehicle's flight needs none of it but its name: its journal holds
/// the mission, the policy and the tables.
struct FlightSurroundings {
  std::string name;               ///< of the folder or the journal
  std::filesystem::path journal;  ///< policy and tables that it does not hold are looked for beside it; "": nowhere
  FlightFiles files;              ///< of a simulator
  RecordingOptions recording;     ///< what a person says
  explain::Baseline baseline = explain::Baseline::kCentre;   ///< with which what a policy saw is compared
  std::optional<std::uint32_t> open_at_step = std::nullopt;  ///< the decision that a page shows first
};

/// How much of a flight somebody has been sent.
struct Sent {
  std::size_t turns = 0;
  std::size_t decisions = 0;
  std::size_t events = 0;
  nlohmann::ordered_json others;  ///< all else, as it was sent last
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
  /// The journal has come to its end, and nobody writes it any more: what is missing there is listed.
  void end(const journal::RecordSource& source);

  /// A `Flight`. Of more turns than `most_rows` every second, third, ... has a row.
  [[nodiscard]] nlohmann::ordered_json whole(std::size_t most_rows = kMostRows);
  /// A `FlightNews`: what has come since `sent`, which is brought up to date. Empty: nothing.
  [[nodiscard]] nlohmann::ordered_json changes(Sent& sent);
  /// What somebody knows who has just been given the whole.
  [[nodiscard]] Sent all_sent();

  /// Its mission has ended, or its journal.
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] const JournalledSearch& journal() const;
  /// Its summary, and what of a simulator's files is missing.
  [[nodiscard]] FlightFiles files() const;
  [[nodiscard]] const std::optional<SeaFlight>& by_journal() const;  ///< nothing: the journal does not begin with a mission
  /// Why its decisions are not explained: a file is missing or at fault, or another policy flew; "" where they are, or nothing is to be.
  [[nodiscard]] const std::string& unexplained() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace earshot::report
