#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "firmware/runtime/runtime.hpp"
#include "tests/safety/drawn_mission.hpp"
#include "tests/safety/true_vehicle.hpp"

namespace earshot::campaign {

/// Where a bit is drawn from.
enum class Part : std::uint8_t {
  kDecisive,  ///< mission and limits, state, latches and timers, and what they are compared with
  kAnywhere,
};

struct FlipResult {
  bool is_noticed = false;
  std::string broken;  ///< which limit; empty: none
};

/// A mission without faults, flown to some moment of its search. From there it can be flown on for a minute, again and again, with one bit
/// of the runtime's memory flipped.
class FlippedFlight {
 public:
  explicit FlippedFlight(std::uint64_t seed);

  /// @param share  in [0, 1): where in the part
  [[nodiscard]] std::uint64_t drawn_bit(Part part, double share) const;
  [[nodiscard]] std::string_view name_of(std::uint64_t bit) const;
  [[nodiscard]] FlipResult fly_with(std::uint64_t bit);

 private:
  /// All that changes from turn to turn.
  struct Moment {
    runtime::Runtime runtime;
    TrueVehicle vehicle;
    Time now;
    std::uint64_t sequence = 0;
    runtime::Outputs outputs;
  };

  /// @return whether it is still searching then
  [[nodiscard]] bool flies_to_moment(int turns);
  void turn(Moment& moment) const;
  [[nodiscard]] std::string broken_in(const Moment& moment) const;

  DrawnMission drawn_;
  std::unique_ptr<Moment> begin_;
  std::unique_ptr<Moment> flown_;
};

}  // namespace earshot::campaign
