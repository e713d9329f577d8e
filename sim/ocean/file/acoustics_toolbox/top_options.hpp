#pragma once

#include <cstdint>
#include <optional>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/acoustics_toolbox/attenuation.hpp"
#include "sim/ocean/file/list_directed/list_reader.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// How sound speed goes on between the depths of a profile.
enum class Interpolation : std::uint8_t {
  kLinear,           ///< C
  kSquaredIndex,     ///< N: 1/c^2 is linear
  kSpline,           ///< S: a cubic spline
  kRangesAndDepths,  ///< Q: linear in depth and in range, from an .ssp file
};

enum class VolumeAttenuation : std::uint8_t { kNone, kThorp, kFrancoisGarrison };

/// What the line of top options says.
struct TopOptions {
  Interpolation interpolation;
  AttenuationUnit unit;
  VolumeAttenuation volume;
  std::optional<AbsorbingWater> water;  ///< of kFrancoisGarrison
};

/// Reads the top options and the line of sea water that may follow them. Throws host::BadInput for a letter whose meaning Earshot has not,
/// naming those that it has.
[[nodiscard]] TopOptions read_top_options(ListReader& file);

}  // namespace earshot::ocean::acoustics_toolbox
