#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::own_search {

/// The few things that everybody changes in a search; all else is as in the mission and the ocean that ship, and is changed in the files.
struct OwnSearch {
  double area_north_m = 25'000.0;  ///< its size; the origin is its south-west corner
  double area_east_m = 25'000.0;
  double latitude_deg = 38.5;  ///< of the origin
  double longitude_deg = -28.0;
  double depth_m = 300.0;
  double speed_mps = 2.0;
  double frequency_hz = 20.0;
  double sea_floor_m = 3000.0;
  double source_level_db = 190.0;       ///< re 1 uPa at 1 m
  std::optional<double> noise_db = {};  ///< re 1 uPa, in the detector's band; absent: as noise_db() says
  std::string lcm_url{host::kDefaultLcmUrl};
  /// All over LCM ("lcm"), all over CAN ("can"), or what a CAN bus brings over that and the rest over LCM ("mixed").
  std::string bus = "lcm";
  std::string can_interface = "can0";
  bool hears = false;                              ///< with a hydrophone of its own, and is told no SNR
  std::optional<double> battery_percent{};         ///< below it the search ends
  std::optional<double> battery_percent_per_km{};  ///< that a kilometre through the water takes of it; absent: nobody said
  std::optional<double> fence_m{};                 ///< so far outside of the area it may be, before it is steered back
  bool own_tables = false;                         ///< of oceans of one's own, where tables that ship would do, too
};

struct Bounds {
  double lowest;
  double highest;
};
inline constexpr Bounds kSide_m{.lowest = 5'000.0, .highest = 35'000.0};
inline constexpr Bounds kLatitude_deg{.lowest = -80.0, .highest = 80.0};
inline constexpr Bounds kLongitude_deg{.lowest = -180.0, .highest = 180.0};
inline constexpr Bounds kDepth_m{.lowest = 1.0, .highest = 11'000.0};
inline constexpr Bounds kSpeed_mps{.lowest = 0.1, .highest = 20.0};
inline constexpr Bounds kFrequency_hz{.lowest = 1.0, .highest = 10'000.0};
inline constexpr Bounds kSourceLevel_db{.lowest = 60.0, .highest = 250.0};
inline constexpr Bounds kNoise_db{.lowest = 0.0, .highest = 200.0};
inline constexpr Bounds kBattery_percent{.lowest = 1.0, .highest = 90.0};
inline constexpr Bounds kBattery_percent_per_km{.lowest = 0.001, .highest = 100.0};
inline constexpr Bounds kFence_m{.lowest = 10.0, .highest = 20'000.0};
/// With a tenth to each side, and the bands beside that in which the noise is learnt: what a hydrophone's detector can (detector::check).
inline constexpr Bounds kHeard_hz{.lowest = 9.1, .highest = 740.0};
inline constexpr Bounds kSeaFloor_m{.lowest = 10.0, .highest = 11'000.0};

/// What a search is flown by.
enum class FliesBy : std::uint8_t {
  kWhatShips,      ///< policy and tables
  kOwnPolicy,      ///< the policy that ships, for an area of another size, and the tables that ship: signed with one's own key, both
  kTablesToBeMade  ///< that policy, signed with one's own key, and tables that `earshot tables` has yet to make: none that ship are of this
                   ///< search
};

/// Whether the policy that ships is for an area of this size; another needs one of its own.
[[nodiscard]] bool is_of_shipped_size(const OwnSearch& search);

/// The furthest that a source may be from the vehicle: the area's diagonal.
[[nodiscard]] double furthest_m(const OwnSearch& search);
/// The deepest set-point that the mission allows: a third below the search, where the sea floor leaves room for it.
[[nodiscard]] double max_depth_m(const OwnSearch& search);
/// A fifth longer than all steps take.
[[nodiscard]] double max_time_s(const OwnSearch& search, double step_length_m, double max_steps);

/// Noise in the detector's band where nobody says it: 90 dB at 20 Hz, the paper's, and at another frequency as much more or less as ships
/// and wind (moderate shipping, 5 m/s) are louder or quieter there.
/// Source: Coates (1990), Underwater Acoustic Systems, ch. 6, fits to Wenz's curves. Oracle: OwnSearch.TakesNoiseForTheFrequency
[[nodiscard]] double noise_db(const OwnSearch& search);

/// @throws BadInput for what does not fit together: a search below the sea floor, a sound that no detector is for
void require_consistent(const OwnSearch& search);

}  // namespace earshot::own_search
