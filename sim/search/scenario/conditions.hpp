#pragma once

#include <cstddef>
#include <optional>

#include "firmware/core/units.hpp"

namespace earshot::search {

inline constexpr std::size_t kMaxSources = 8;  ///< sources of one search

/// A source that sings and falls silent: calls every `interval_s` for `song_s`, then none for `pause_s`, and so on. A measurement hears a
/// call that fell in the `listening_s` before it. Where in its song a source is when the search begins is drawn anew for every search.
struct CallPattern {
  double interval_s;   ///< > 0
  double song_s;       ///< > 0
  double pause_s;      ///< >= 0
  double listening_s;  ///< > 0
};

/// Water that carries the vehicle while it steers as if it stood still.
struct Current {
  MetersPerSecond speed;          ///< >= 0
  std::optional<Radians> toward;  ///< clockwise from north; absent: drawn anew for every search
  enum class Navigation : bool { kDoesNotSeeIt, kSeesIt } navigation = Navigation::kSeesIt;  ///< e.g. a Doppler log on the sea floor
};

/// An array that hears from where a call comes.
struct BearingConditions {
  Radians deviation;          ///< > 0 and at most pi: standard deviation of a bearing, normal, drawn anew at every measurement
  bool is_ambiguous = false;  ///< a line along the vehicle's course: it cannot tell left from right
};

/// What a hydrophone suffers from in a flight that hears sound; a modelled SNR knows nothing of it.
struct SoundConditions {
  double lost_blocks = 0.0;   ///< share of the blocks of sound that are lost between ADC and bus, 0 to 1
  Decibels self_noise{65.0};  ///< of the vehicle's way through the water at 2 m/s, in the detector's band, dB re 1 uPa
};

/// How a search departs from one where every measurement gives the modelled SNR and nothing but the vehicle moves. Everything is off by
/// default.
struct Conditions {
  Decibels fluctuation;  ///< sigma >= 0 of the SNR, normal in dB, drawn anew at every measurement
  std::optional<Decibels>
      least_fluctuation;             ///< sigma is uniform between this and `fluctuation`, drawn for every search; absent: it is that
  std::optional<Decibels> floor;     ///< the least SNR that can be measured
  Decibels source_level_spread;      ///< >= 0: the true level lies uniformly within so much of the environment's, drawn for every search
  double drift_m_per_sqrt_km = 0.0;  ///< >= 0: standard deviation of navigation's error, each of north and east, after 1 km; a random walk
  MetersPerSecond source_speed;      ///< >= 0; on a straight course, drawn for every search, reflected at the domain's edges
  std::size_t sources = 1;           ///< 1 to kMaxSources; the loudest is heard, any may be found. All but the first are drawn uniformly
  std::optional<Current> current;    ///< absent: none
  std::optional<CallPattern> calls;  ///< absent: always heard; needs `floor`, which is what silence says of the SNR
  MetersPerSecond vehicle_speed{2.0};  ///< > 0: how long a step takes
  std::optional<BearingConditions>
      bearing;  ///< of the source that is heard, at every measurement that can be measured; absent: none is measured
  SoundConditions sound;
};

/// True when nothing departs.
[[nodiscard]] inline bool is_calm(const Conditions& c) {
  return c.fluctuation.value == 0.0 && !c.floor && c.source_level_spread.value == 0.0 && c.drift_m_per_sqrt_km == 0.0 &&
         c.source_speed.value == 0.0 && c.sources == 1 && !c.current && !c.calls && !c.bearing;
}

}  // namespace earshot::search
