#pragma once

#include <string>
#include <utility>
#include <vector>

namespace earshot::netcdf {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// What the files keep to, as their attribute `Conventions` says. Oracle: the IOOS compliance-checker (tests/sim/netcdf/conventions/run)
inline constexpr const char* kConventions = "CF-1.11";

/// The unit of a level, or of a ratio, in dB: 10 lg(x / reference), where x is a mean square or a power.
/// CF 1.11 takes units from UDUNITS (section 3.1), which knows no "dB", but a tenth of the common logarithm of what stands in brackets:
/// a square where people name its root (1 uPa), and times 1 m2 where they say "at 1 m".
/// Source: CF 1.11, section 3.1; ISO 18405:2017, the squared reference values of levels, source levels and propagation loss
struct LevelUnit {
  const char* words;    ///< for people
  const char* udunits;  ///< the attribute `units`
};

inline constexpr LevelUnit kRatio{"dB", "0.1 lg(re 1)"};
inline constexpr LevelUnit kReOneMeter{"dB re 1 m", "0.1 lg(re 1 m2)"};
inline constexpr LevelUnit kReOneMicropascal{"dB re 1 uPa", "0.1 lg(re 1 uPa2)"};
inline constexpr LevelUnit kReOneMicropascalAtOneMeter{"dB re 1 uPa at 1 m", "0.1 lg(re 1 uPa2 m2)"};
inline constexpr LevelUnit kReFullScale{"dB re full scale", "0.1 lg(re 1)"};

/// A long_name that ends with the unit in words, `units`, and the words alone as `level_unit`, which is ours and not of CF.
[[nodiscard]] inline Attributes level_attributes(const std::string& what, const LevelUnit& unit) {
  return {{"long_name", what + ", " + unit.words}, {"units", unit.udunits}, {"level_unit", unit.words}};
}

}  // namespace earshot::netcdf
