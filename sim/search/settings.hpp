#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/config/listening_window.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/heard.hpp"

namespace earshot::search {

/// Where the source stands at the start of an episode.
enum class SourcePlacement : std::uint8_t {
  kFixed,     ///< at SearchSettings::source
  kChanging,  ///< uniform in the domain, anew every episode
};

/// The paper's search problem. Defaults are the paper's; what the paper leaves open says so.
/// Source: Clark et al. 2022 (domain, source position, l, N, DT, p); border_width b is not given there.
struct SearchSettings {
  Rectangle domain{{Meters{0.0}, Meters{0.0}}, {Meters{25'000.0}, Meters{25'000.0}}};
  Rectangle start_region{{Meters{0.0}, Meters{0.0}},
                         {Meters{25'000.0}, Meters{25'000.0}}};  ///< vehicle starts uniform in it; inside the domain
  SourcePlacement placement = SourcePlacement::kFixed;
  NorthEast source{Meters{10'000.0}, Meters{10'000.0}};  ///< used when placement is kFixed
  std::size_t direction_count = 8;                       ///< n compass directions, 1 to config::kMaxActions
  Meters step_length{1'000.0};                           ///< l > 0; within l of the source it is found
  std::uint32_t max_steps = 100;                         ///< N >= 1
  Decibels detection_threshold{10.0};                    ///< DT
  config::ListeningWindow listening;                     ///< what an observation hears of the looks on its step
  Meters border_width{1'000.0};                          ///< b > 0; not given by the paper
  double border_reward = -100.0;                         ///< p, the reward at the edge itself
};

/// The part of the domain where the border's reward does not reach: every edge moved in by border_width. Starts there begin without
/// penalty.
[[nodiscard]] Rectangle inside_border(const SearchSettings& settings);

/// How far a source can be from a vehicle: from corner to corner of the domain and a step beyond.
[[nodiscard]] Meters furthest_range(const SearchSettings& settings);

/// Between two looks of a vehicle under way: the simulator's tick.
inline constexpr Duration kLookInterval = Duration::seconds(1);

/// The looks that count on a leg that lasts so long: one every kLookInterval back from its end, as far as window and leg reach, and one at
/// least.
/// Oracle: LooksOnLeg.*
[[nodiscard]] std::size_t looks_on_leg(config::ListeningWindow window, double leg_s);

/// kOutOfRange when a number is not finite or outside its range, the start region leaves the domain, or there is no room for a search:
/// every start is within l of the source (fixed source), or of every place where it may be (changing source).
[[nodiscard]] Status check(const SearchSettings& settings);

/// Reward of one step that ends at `position`, where `snr` is heard.
///
///   r = (0 if SNR >= DT else -1) + (p (b - d_e) / b if d_e < b)
///
/// @param position  in the domain's frame; d_e, the distance to the nearest edge, is negative outside, where the penalty grows beyond p
/// Source: Clark et al. 2022, reward.   Oracle: StepReward.*
[[nodiscard]] double step_reward(const SearchSettings& settings, NorthEast position, Decibels snr);

/// Whether what was heard is a detection: measured, and SNR >= DT.
[[nodiscard]] bool is_detection(const SearchSettings& settings, policy::Heard heard);
/// As above: what was too faint to measure is no detection, wherever the floor lies.
[[nodiscard]] double step_reward(const SearchSettings& settings, NorthEast position, policy::Heard heard);

/// Takes two numbers from `random`.
[[nodiscard]] NorthEast uniform_in(const Rectangle& area, Pcg32& random);

using ActionTable = FixedVector<UnitNorthEast, config::kMaxActions>;

/// `count` compass directions (1 to config::kMaxActions), clockwise, action 0 north. Cardinal directions are exact.
[[nodiscard]] ActionTable compass_directions(std::size_t count);

}  // namespace earshot::search
