#pragma once

#include <variant>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/search/scenario/conditions.hpp"

namespace earshot::hydrophone {

// What a source sends out against its own time, scaled so that its root mean square is 1 while it calls: times the received level it is the
// sound at the hydrophone.

/// A tone that never ends.
struct Tone {
  Hertz frequency{20.0};
  [[nodiscard]] double at(double time_s) const;
};

/// A fin whale's song: a pulse of one second that falls from 23 to 18 Hz (of a source at 20 Hz), swelling and dying away as sin^2, every
/// `interval_s` of a song, then the pause. Its mean square over its second is 1.
///
///   pulse = 4 / sqrt(3) sin^2(pi t) cos(2 pi (f1 t - (f1 - f2) t^2 / 2)),   0 <= t <= 1 s
///
/// Source: Watkins et al. 1987, J. Acoust. Soc. Am. 82, 1901: pulses of about 1 s, 23 to 18 Hz.
struct Song {
  search::CallPattern pattern;
  Hertz frequency{20.0};
  [[nodiscard]] double at(double time_s) const;
};

inline constexpr double kPulse_s = 1.0;

/// Recorded sound, again and again. Between its samples it is a cubic through the four nearest (Catmull-Rom).
struct Recording {
  std::vector<float> samples;  ///< at least one; what is to be the received level has a root mean square of 1
  Hertz sample_rate;
  [[nodiscard]] double at(double time_s) const;
};

using Calls = std::variant<Tone, Song, Recording>;

}  // namespace earshot::hydrophone
