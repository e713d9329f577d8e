#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/band.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/options.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar {

/// Between ranges, where nobody names a step: of a radial, and of the many of a fan.
inline constexpr double kRadialStepWavelengths = 1.0 / 6.0;
inline constexpr double kFanStepWavelengths = 1.0 / 3.0;

/// What somebody wants of a radial from the environment's source; what is left empty is chosen after the ocean.
struct RadialRequest {
  Meters max_range{25'000.0};
  std::vector<double> depth_m = {};          ///< of receivers, > 0, increasing; empty: every `depth_spacing` down to the sea floor
  std::optional<Meters> depth_spacing = {};  ///< empty: 10 m, in water of less than 1000 m a hundredth of it or less
  std::optional<Meters> output_step = {};    ///< between ranges; empty: that of the options, else `default_step_wavelengths`
  double default_step_wavelengths = kRadialStepWavelengths;  ///< of the band's highest frequency, in water of 1500 m/s
  ocean::Band band;
  pe::Options options = {};
};

/// A request that no field can meet. Whoever asked has a name of its own for what is wrong.
class BadRequest : public std::invalid_argument {
 public:
  enum class What : std::uint8_t { kDepth, kOutputStep, kBearing, kRadials };

  /// @param complaint  "must be from 0 m to the sea floor, ..."
  BadRequest(What what, double value, const std::string& complaint);
  [[nodiscard]] What what_is_wrong() const { return what_; }
  [[nodiscard]] double value() const { return value_; }
  /// "--depth = 0: at the surface ...", of its name "--depth".
  [[nodiscard]] std::string called(const std::string& name) const;

 private:
  What what_;
  double value_;
  std::string complaint_;
};

/// All of a plan but its depths, for which the sea floor must be known. @throws BadRequest for a step longer than the range.
[[nodiscard]] RadialPlan plan_ranges(const RadialRequest& request, Meters source_depth);

/// The receivers' depths. Throws BadRequest naming a depth that no radial has water at, and for more values than kMostFanValues.
/// @param radials  that the plan is computed on
void plan_depths(const RadialRequest& request, std::size_t radials, Meters deepest_sea_floor, RadialPlan& plan);

/// A radial that can be computed, and the ocean along it.
struct PlannedRadial {
  ocean::Section section;
  RadialPlan plan;
};

/// Throws BadRequest, and as ocean::section_along does. Oracle: RadialRequest.*
/// @param bearing  clockwise from north
[[nodiscard]] PlannedRadial plan_radial(const ocean::Environment& environment, Radians bearing, const RadialRequest& request);

/// A fan that can be computed, about the environment's source.
struct PlannedFan {
  FanPlan plan;
  /// What to say where some bearings meet land nearer than the first range: there is no number on them.
  std::optional<std::string> land = {};
};

/// Throws BadRequest, also where no bearing has water as far as the first range, and as ocean::section_along does. Oracle: FanRequest.*
/// @param bearings  one or more
[[nodiscard]] PlannedFan plan_fan(const ocean::Environment& environment, std::size_t bearings, const RadialRequest& request);

}  // namespace earshot::sonar
