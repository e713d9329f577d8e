#pragma once

#include <optional>
#include <string>
#include <vector>

#include "policy/report/conditions.hpp"
#include "policy/report/flight_files.hpp"

namespace earshot::report {

/// What is said of a flight is made of this.
struct FlightSources {
  const FlightFiles& files;  ///< of a simulator
  const JournalledSearch& journal;
  const std::optional<SeaFlight>& by_journal;  ///< nothing: the journal does not begin with a mission
  const std::string& unexplained;              ///< why its decisions are not explained; "": they are
  bool uses_measurements = true;               ///< false: the policy goes by place and steps alone
  bool is_being_written = false;               ///< what the journal lacks at its end may still come
};

/// How it went, in one sentence without its full stop.
struct FlightVerdict {
  std::string text;
  std::optional<bool> is_found = std::nullopt;  ///< nothing: that is open
};
[[nodiscard]] FlightVerdict verdict_on(const FlightSources& flight);

/// What a reader should know first.
[[nodiscard]] std::vector<std::string> sentences_on(const FlightSources& flight);

/// What was searched for and how, and what came of it, in numbers.
[[nodiscard]] std::vector<Condition> facts_of(const FlightSources& flight);

/// What its files lack, and what could not be read.
[[nodiscard]] std::vector<std::string> shortcomings_of(const FlightSources& flight);

}  // namespace earshot::report
