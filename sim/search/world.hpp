#pragma once

#include "sim/ocean/conditions.hpp"
#include "sim/search/settings.hpp"
#include "sim/search/soundscape.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// What never changes while episodes run; must outlive them.
struct SearchWorld {
  SearchSettings settings;
  const sonar::SnrCurve& snr;  ///< SNR at the vehicle's depth against horizontal range, as the environment has it; covers the diagonal
  ActionTable actions;
  ocean::Conditions conditions;
  const Soundscape* soundscape;  ///< null: a calm world of one ocean, in which `snr` is all there is to hear

  SearchWorld(const SearchSettings& s, const sonar::SnrCurve& curve)
      : settings(s), snr(curve), actions(compass_directions(s.direction_count)), soundscape(nullptr) {}

  SearchWorld(const SearchSettings& s, const Soundscape& sounds, const ocean::Conditions& c)
      : settings(s),
        snr(sounds.expected()),
        actions(compass_directions(s.direction_count)),
        conditions(c),
        soundscape(ocean::is_calm(c) && sounds.is_one_curve() ? nullptr : &sounds) {}
};

}  // namespace earshot::search
