#pragma once

#include <cstdint>

#include "policy/report/document/growing_flight.hpp"
#include "policy/watch/flight_source.hpp"
#include "policy/watch/http/audience.hpp"

namespace earshot::watch {

/// Brings a flight to its audience: to each browser the whole once, and what comes after it. What costs time is done once for all of them,
/// and not at all where nobody is there.
/// Oracle: Publisher.*
class Publisher {
 public:
  explicit Publisher(Audience& audience) : audience_(audience) {}
  /// @param change  of the flight since the last call
  void update(report::GrowingFlight& flight, Change change);

 private:
  Audience& audience_;
  report::Sent sent_;  ///< to all that were given the whole
  Frame whole_;        ///< nothing: the flight has changed since
};

}  // namespace earshot::watch
