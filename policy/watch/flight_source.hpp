#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

#include "firmware/host/journal/reading/entry.hpp"
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

  /// @param observer  is given every entry of the flight, in order, from the next take() on
  void observe(std::function<void(const journal::Entry&)> observer) { observer_ = std::move(observer); }

 protected:
  void add(const journal::Entry& entry) {
    flight().take(entry);
    if (observer_) observer_(entry);
  }

 private:
  std::function<void(const journal::Entry&)> observer_;
};

}  // namespace earshot::watch
