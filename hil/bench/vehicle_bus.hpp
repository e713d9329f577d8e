#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/nodes/vehicle/disturbance.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// Of the bench: a turn of earshotd is a second at sea.
inline constexpr Duration kTick = Duration::seconds(1);

/// A bus does not carry what it should: the flight cannot be flown to its end.
class BusTrouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The other side of earshotd's bus: a vehicle, its devices, those who should not be there, and the faults between all of them and Earshot.
class VehicleBus {
 public:
  VehicleBus() = default;
  virtual ~VehicleBus() = default;
  VehicleBus(const VehicleBus&) = delete;
  VehicleBus& operator=(const VehicleBus&) = delete;

  /// Where earshotd finds it: what its command line says of it.
  [[nodiscard]] virtual std::vector<std::string> options_of_earshotd() const = 0;
  [[nodiscard]] virtual const vehicle::State& state() const = 0;
  [[nodiscard]] virtual Meters range() const = 0;  ///< horizontal, to the source

  virtual void disturb(const Disturbance& disturbance) = 0;
  /// The vehicle moves on, and all that is said at `now` is in earshotd's socket when this returns. @throws BusTrouble
  virtual void send_due(Time now) = 0;
  /// The same once more, for an earshotd that was away. @throws BusTrouble
  virtual void send_again() = 0;
  /// What Earshot said in its turn at `now` reaches the vehicle. @param is_there  whether earshotd still runs   @throws BusTrouble
  virtual void hear(Time now, const std::function<bool()>& is_there) = 0;
  /// The computer's interface is taken down, or comes back, and earshotd has had the time to notice.
  virtual void switch_interface(bool is_up) = 0;

  /// Adds what is kept of it.
  virtual void report(BenchFlight& flight) = 0;
};

}  // namespace earshot::hil
