#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::search {

/// How one source is received at the vehicle.
struct Arrival {
  Meters range;
  Decibels snr;                                             ///< as a call would be received now, fluctuation included
  bool has_called = true;                                   ///< within the listening time of its pattern
  double sung_s = 0.0;                                      ///< its own time when the search began
  std::optional<messages::Bearing> bearing = std::nullopt;  ///< as an array would measure it now; absent: there is none
};
using Arrivals = FixedVector<Arrival, kMaxSources>;

/// What stands around the vehicle in one search: drawn at its start, changed by every step. In a calm world that is one source at rest,
/// and nothing is drawn. Trivially copyable.
class Surroundings {
 public:
  /// What `start` draws from: a stream of its own, seeded by two numbers of `random`. A calm world takes none.
  [[nodiscard]] static Pcg32 stream_from(const World& world, Pcg32& random);
  /// Draws everything but the first source and the start. A further source within l of the start is drawn again.
  void start(const World& world, NorthEast vehicle, NorthEast source, Pcg32 random);

  /// Time has passed: sources have swum, the current has carried the vehicle, navigation has drifted.
  /// @param through_water  what the vehicle has moved of itself
  /// @return what it has moved over ground
  NorthEast pass(const World& world, NorthEast through_water, double time_s);
  /// As above, for a vehicle that has gone from one place to another through the water. @return where it is over ground
  NorthEast carry(const World& world, NorthEast from, NorthEast to, double time_s);

  /// The hydrophone's reception of the loudest source now; every measurement draws anew.
  ///
  ///   SNR = SL + offset - TL - N + sigma * n,   n normal;   not measured below the floor, or when no call fell in the listening time
  ///   bearing = direction of that source + deviation * n';   with what is measured, where the conditions have an array
  ///
  /// Of an array that cannot tell left from right the bearing is the one to starboard of the vehicle's course, wherever the source is.
  /// Oracle: Surroundings.*
  [[nodiscard]] policy::Reception listen(const World& world, NorthEast vehicle);

  /// What listen() makes one reception of, source by source: for who hears the sound itself. Draws what listen() draws.
  [[nodiscard]] Arrivals arrivals(const World& world, NorthEast vehicle);
  /// What listen() would have returned.
  [[nodiscard]] policy::Reception reception_of(const World& world, const Arrivals& arrivals) const;

  /// The ocean that it is in, of the soundscape's.
  [[nodiscard]] std::size_t ocean() const { return ocean_; }
  /// Where navigation believes the vehicle, less where it is.
  [[nodiscard]] NorthEast navigation_error() const { return drift_ - unseen_current_; }
  /// Of the source nearest to the vehicle.
  [[nodiscard]] NorthEast nearest_source(NorthEast vehicle) const;

 private:
  struct Source {
    NorthEast position;
    UnitNorthEast course;
    std::size_t field = 0;
    double sung_s = 0.0;  ///< since its song began, before the search did
  };

  void add_source(const World& world, NorthEast position);
  void put(const Source& source);
  void swim(const World& world, Source& source, double time_s);
  [[nodiscard]] messages::Bearing draw_bearing(const BearingConditions& array, const Source& source, NorthEast vehicle);
  [[nodiscard]] Decibels draw_snr(const World& world, const Source& source, NorthEast vehicle);
  [[nodiscard]] bool has_called(const CallPattern& calls, const Source& source) const;
  [[nodiscard]] double normal();

  bool is_calm_ = true;
  Pcg32 random_{0};
  FixedVector<Source, kMaxSources> sources_;
  std::size_t ocean_ = 0;
  Decibels level_offset_;
  Decibels fluctuation_;
  UnitNorthEast current_toward_;
  Radians course_;  ///< through the water, of the last move; north before the first
  NorthEast unseen_current_;
  NorthEast drift_;
  double now_s_ = 0.0;
};

}  // namespace earshot::search
