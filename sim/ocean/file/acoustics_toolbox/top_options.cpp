#include "sim/ocean/file/acoustics_toolbox/top_options.hpp"

#include <array>
#include <string>

namespace earshot::ocean::acoustics_toolbox {
namespace {

using host::Range;

constexpr const char* kWhat = "top options";

Interpolation interpolation_of(const ListReader& file, const std::string& options) {
  switch (options[0]) {
    case 'C':
      return Interpolation::kLinear;
    case 'N':
      return Interpolation::kSquaredIndex;
    case 'S':
      return Interpolation::kSpline;
    case 'Q':
      return Interpolation::kRangesAndDepths;
    default:
      throw file.error(kWhat, options, "the first letter must be C, N, S or Q, how sound speed goes on between depths");
  }
}

AttenuationUnit unit_of(const ListReader& file, const std::string& options) {
  switch (options[2]) {
    case 'N':
      return AttenuationUnit::kNepersPerMeter;
    case 'M':
      return AttenuationUnit::kDecibelsPerMeter;
    case 'F':
      return AttenuationUnit::kDecibelsPerMeterKilohertz;
    case 'W':
      return AttenuationUnit::kDecibelsPerWavelength;
    case 'Q':
      return AttenuationUnit::kQuality;
    case 'L':
      return AttenuationUnit::kLoss;
    default:
      throw file.error(kWhat, options, "the third letter must be N, M, F, W, Q or L, the unit of attenuation");
  }
}

VolumeAttenuation volume_of(const ListReader& file, const std::string& options) {
  switch (options[3]) {
    case ' ':
      return VolumeAttenuation::kNone;
    case 'T':
      return VolumeAttenuation::kThorp;
    case 'F':
      return VolumeAttenuation::kFrancoisGarrison;
    default:
      throw file.error(kWhat, options, "the fourth letter must be a blank, T or F, the formula by which sea water absorbs");
  }
}

AbsorbingWater read_water(ListReader& file) {
  std::array<double, 4> values{};
  if (file.numbers(values, "sea water") < values.size())
    throw file.error("sea water", "less than 4 numbers", "must be temperature, salinity, pH and depth");
  file.require("temperature in degC", values[0], Range::between(-2.0, 40.0));
  file.require("salinity in psu", values[1], Range::between(0.0, 50.0));
  file.require("pH", values[2], Range::between(7.0, 9.0));
  file.require("mean depth in m", values[3], Range::between(0.0, 12'000.0));
  return {.water = {.temperature_c = values[0], .salinity_psu = values[1], .acidity_ph_nbs = values[2]}, .depth = Meters{values[3]}};
}

}  // namespace

TopOptions read_top_options(ListReader& file) {
  std::string options = file.text(kWhat);
  options.resize(std::max<std::size_t>(options.size(), 6), ' ');
  const Interpolation interpolation = interpolation_of(file, options);
  if (options[1] != 'V') throw file.error(kWhat, options, "the second letter must be V, a sea surface without pressure");
  const AttenuationUnit unit = unit_of(file, options);
  const VolumeAttenuation volume = volume_of(file, options);
  constexpr const char* kWithoutMeaning = " _-.";  // flat; KRAKEN's choice of a root finder
  if (std::string(kWithoutMeaning).find(options[4]) == std::string::npos)
    throw file.error(kWhat, options, "the fifth letter must be a blank, - or _, a flat sea surface");
  if (options.find_first_not_of(' ', 5) != std::string::npos)
    throw file.error(kWhat, options, "there must be nothing behind the fifth letter: one frequency, all of the beams");
  TopOptions result{.interpolation = interpolation, .unit = unit, .volume = volume, .water = {}};
  if (volume == VolumeAttenuation::kFrancoisGarrison) result.water = read_water(file);
  return result;
}

}  // namespace earshot::ocean::acoustics_toolbox
