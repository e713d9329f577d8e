#pragma once

#include <chrono>
#include <cstdint>

#include "policy/report/document/growing_flight.hpp"

namespace earshot::watch {

enum class Change : std::uint8_t {
  kNone,
  kMore,   ///< the flight has grown
  kOther,  ///< it is another one now
};

/// Where a flight comes from that somebody watches.
class FlightSource {
 public:
  FlightSource() = default;
  FlightSource(const FlightSource&) = delete;
  FlightSource& operator=(const FlightSource&) = delete;
  virtual ~FlightSource() = default;

  /// Takes what has come, without waiting. @throws host::BadInput when it cannot be read, or does not come
  [[nodiscard]] virtual Change take() = 0;
  [[nodiscard]] virtual report::GrowingFlight& flight() = 0;
  /// Until more may have come, so long at most.
  virtual void wait(std::chrono::milliseconds most) = 0;
};

}  // namespace earshot::watch
