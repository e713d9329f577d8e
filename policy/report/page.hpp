#pragma once

#include <string>
#include <vector>

#include "policy/explain/decision_account.hpp"
#include "policy/report/flight_files.hpp"

namespace earshot::report {

/// Why a flight's decisions were taken; one account and one chart for each of them, or none and the reason.
struct FlightExplanation {
  bool uses_measurements = true;  ///< false: the policy goes by place and steps alone
  std::vector<explain::DecisionAccount> accounts = {};
  std::vector<std::string> charts = {};  ///< SVG text
  std::string why_not = {};              ///< one line when there are no accounts
  bool is_incomplete = false;            ///< there are none because a file of the flight is missing or cannot be read
};

/// Explains every decision of the flight in a folder, or of a journal, or says in one line why that cannot be done.
[[nodiscard]] FlightExplanation explain_flight(const std::filesystem::path& folder_or_journal);

struct Pictures {
  std::string map;         ///< SVG text
  std::string history;     ///< SVG text
  std::string sound = {};  ///< SVG text; of a flight that heard
};

/// Of a flight at sea what its journal tells; of a simulated one nothing unless all its files are there.
[[nodiscard]] Pictures pictures_of(const Flight& flight);

/// A page that needs no other file: what happened, the two pictures, every decision with its reasons to unfold.
[[nodiscard]] std::string page(const Flight& flight, const Pictures& pictures, const FlightExplanation& explanation);

}  // namespace earshot::report
