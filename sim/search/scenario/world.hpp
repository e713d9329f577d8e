#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/scenario/conditions.hpp"
#include "sim/search/scenario/scenario.hpp"
#include "sim/search/scenario/soundscape.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// What never changes while episodes run; must outlive them.
struct World {
  SearchSettings settings;
  ActionTable actions;  ///< the compass directions of the settings, unless a policy brings its own
  Conditions conditions;
  std::shared_ptr<const Soundscape> soundscape;  ///< not null; covers the diagonal

  /// A calm world of one ocean.
  World(const SearchSettings& s, const sonar::SnrCurve& curve) : World(s, Soundscape(std::vector{curve}), {}) {}
  World(const SearchSettings& s, Soundscape sounds, const Conditions& c)
      : World(s, std::make_shared<const Soundscape>(std::move(sounds)), c) {}
  World(const SearchSettings& s, std::shared_ptr<const Soundscape> sounds, const Conditions& c)
      : settings(s), actions(compass_directions(s.direction_count)), conditions(c), soundscape(std::move(sounds)) {}

  /// SNR at the vehicle's depth against horizontal range, as the environment has it.
  [[nodiscard]] const sonar::SnrCurve& expected() const { return soundscape->expected(); }
  /// Whether every measurement gives the expected SNR and nothing but the vehicle moves.
  [[nodiscard]] bool is_calm() const { return search::is_calm(conditions) && soundscape->is_one_curve(); }
};

/// The world of a scenario: what trains, flies in simulation and is evaluated, whoever asks.
///
/// @param furthest  range that can be heard over
/// Throws as soundscape_of does.
[[nodiscard]] World assemble(const Scenario& scenario, const SearchSettings& settings, Meters vehicle_depth, Meters furthest);
/// As far as furthest_range(settings).
[[nodiscard]] World assemble(const Scenario& scenario, const SearchSettings& settings, Meters vehicle_depth);

}  // namespace earshot::search
