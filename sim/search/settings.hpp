#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/config/listening_window.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::search {

/// Where the source stands at the start of an episode.
enum class SourcePlacement : std::uint8_t {
  kFixed,     ///< at SearchSettings::source
  kChanging,  ///< uniform in the domain, anew every episode
};

/// Who says that the source is found, and so ends the search.
enum class FoundBy : std::uint8_t {
  kSimulator,  ///< it knows that the vehicle is within l of the source
  kSearcher,   ///< as at sea: an episode goes on, and whoever flies it ends it
};

/// The paper's search problem. Defaults are the paper's; what the paper leaves open says so.
/// Source: Clark et al. 2022 (domain, source position, l, N, DT, p); border_width b is not given there.
struct SearchSettings {
  Rectangle domain{{Meters{0.0}, Meters{0.0}}, {Meters{25'000.0}, Meters{25'000.0}}};
  /// The vehicle starts uniform in it; inside the domain.
  Rectangle start_region{{Meters{0.0}, Meters{0.0}}, {Meters{25'000.0}, Meters{25'000.0}}};
  SourcePlacement placement = SourcePlacement::kFixed;
  NorthEast source{Meters{10'000.0}, Meters{10'000.0}};  ///< used when placement is kFixed
  std::size_t direction_count = 8;                       ///< n compass directions, 1 to config::kMaxActions
  Meters step_length{1'000.0};                           ///< l > 0; within l of the source it is found
  std::uint32_t max_steps = 100;                         ///< N >= 1
  Decibels detection_threshold{10.0};                    ///< DT
  config::ListeningWindow listening;                     ///< what an observation hears of the measurements on its step
  Meters border_width{1'000.0};                          ///< b > 0; not given by the paper
  double border_reward = -100.0;                         ///< p, the reward at the edge itself
  FoundBy found_by = FoundBy::kSimulator;
};

/// The part of the domain where the border's reward does not reach: every edge moved in by border_width. Starts there begin without
/// penalty.
[[nodiscard]] Rectangle inside_border(const SearchSettings& settings);

/// How far a source can be from a vehicle: from corner to corner of the domain and a step beyond.
[[nodiscard]] Meters furthest_range(const SearchSettings& settings);

/// Between two measurements of a vehicle under way: the simulator's tick.
inline constexpr Duration kMeasurementInterval = Duration::seconds(1);

/// The measurements that count on a leg that lasts so long: one every kMeasurementInterval back from its end, as far as window and leg
/// reach, and one at least. Oracle: MeasurementsOnLeg.*
[[nodiscard]] std::size_t measurements_on_leg(config::ListeningWindow window, double leg_s);

/// kOutOfRange when a number is not finite or outside its range, the start region leaves the domain, or there is no room for a search:
/// every start is within l of the source (fixed source), or of every place where it may be (changing source).
[[nodiscard]] Status check(const SearchSettings& settings);

/// Takes two numbers from `random`.
[[nodiscard]] NorthEast uniform_in(const Rectangle& area, Pcg32& random);

}  // namespace earshot::search
