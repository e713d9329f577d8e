#include "sim/sonar/radial.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "sim/ocean/charts/charts.hpp"
#include "sim/pe/solver.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

/// A hydrophone may lie on the sea floor.
bool in_water(double depth_m, float floor_m) {
  return floor_m > 0.0F && static_cast<float>(depth_m) <= floor_m;
}

/// Receivers that lie in the water somewhere on the radial: the solver's grid reaches no deeper than it needs to.
struct WetReceivers {
  std::vector<std::size_t> number;  ///< among the plan's depths
  std::vector<double> depth_m;
};

WetReceivers wet_receivers(const std::vector<double>& depth_m, std::span<const float> sea_floor_depth_m) {
  const float deepest = *std::max_element(sea_floor_depth_m.begin(), sea_floor_depth_m.end());
  WetReceivers wet;
  for (std::size_t j = 0; j < depth_m.size(); ++j) {
    if (!in_water(depth_m[j], deepest)) continue;
    wet.number.push_back(j);
    wet.depth_m.push_back(depth_m[j]);
  }
  return wet;
}

using Intensities = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What a band sounds like at the receivers in the water.
struct BandSound {
  Intensities mean;  ///< of |p|^2 over the band, [n_range x n_wet_depth]; empty of one frequency, which has `last`
  pe::Field last;    ///< of its highest frequency
};

BandSound sound_of_band(const ocean::Section& section, const RadialPlan& plan, const std::vector<double>& depth_m, Meters max_range,
                        const pe::Progress& progress) {
  pe::Options options = plan.options;
  options.output_step = plan.range_step;
  const std::vector<double> frequency_hz = frequencies_hz(plan.band);
  BandSound sound;
  Intensities& mean = sound.mean;
  const auto count = static_cast<double>(frequency_hz.size());
  for (std::size_t i = 0; i < frequency_hz.size(); ++i) {
    const auto report = [&](double fraction) {
      if (progress) progress((static_cast<double>(i) + fraction) / count);
    };
    sound.last = {};  // two fields at once would take twice the memory
    sound.last = pe::solve(section, {Hertz{frequency_hz[i]}, plan.source_depth}, options, depth_m, max_range, report);
    if (frequency_hz.size() == 1) break;
    if (i == 0)
      mean = sound.last.pressure.abs2();
    else
      mean += sound.last.pressure.abs2();
  }
  if (count > 1.0) mean /= count;
  return sound;
}

/// There is no sound at the values from `begin` to before `end`.
void fill_nowhere(const RadialLoss& loss, std::size_t begin, std::size_t end) {
  std::ranges::fill(loss.transmission_loss_db.subspan(begin, end - begin), kNowhere);
  if (!loss.pressure.empty()) std::ranges::fill(loss.pressure.subspan(begin, end - begin), std::complex<double>(kNowhere, kNowhere));
}

/// NaN in a field means that there is no water; a march that went wrong must not look like that.
[[noreturn]] void throw_no_number(const std::string& name, Meters range, double depth_m) {
  std::ostringstream text;
  text << name << ": the solver's sound at " << range.value << " m of range and " << depth_m
       << " m of depth is no finite number; choose another grid";
  throw std::runtime_error(text.str());
}

}  // namespace

std::vector<double> frequencies_hz(const ocean::Band& band) {
  if (!(band.high > band.low)) return {band.low.value};
  std::vector<double> frequency;
  for (std::size_t i = 0; i < band.count; ++i)
    frequency.push_back(std::lerp(band.low.value, band.high.value, (static_cast<double>(i) + 0.5) / static_cast<double>(band.count)));
  return frequency;
}

bool differs_with_place(const ocean::Environment& environment) {
  return environment.charts != nullptr && (environment.charts->bathymetry || environment.charts->climatology);
}

Meters deepest_sea_floor(const ocean::Section& section, Meters max_range) {
  Meters deepest = std::max(ocean::sea_floor_depth(section, Meters{}), ocean::sea_floor_depth(section, max_range));
  for (const auto& station : section.sea_floor) {
    if (station.range <= max_range) deepest = std::max(deepest, station.depth);
  }
  return deepest;
}

std::optional<Meters> shore_before(const ocean::Section& section, Meters range) {
  return section.shore && *section.shore < range ? section.shore : std::nullopt;
}

std::optional<pe::MarchGrid> compute_radial(const ocean::Section& section, const std::string& name, const RadialPlan& plan,
                                            const RadialLoss& loss, const pe::Progress& progress) {
  const std::size_t depths = plan.depth_m.size();
  assert(loss.transmission_loss_db.size() == plan.ranges * depths && loss.sea_floor_depth_m.size() == plan.ranges);
  assert(loss.pressure.empty() || (loss.pressure.size() == plan.ranges * depths && !(plan.band.high > plan.band.low)));
  const Meters max_range = plan.max_range();
  const Meters end = section.shore ? std::min(*section.shore, max_range) : max_range;

  for (std::size_t i = 0; i < plan.ranges; ++i) {
    const Meters range = static_cast<double>(i + 1) * plan.range_step;
    loss.sea_floor_depth_m[i] = static_cast<float>(ocean::sea_floor_depth(section, range).value);  // 0 from the shore on
  }
  const WetReceivers wet = wet_receivers(plan.depth_m, loss.sea_floor_depth_m);
  if (wet.number.empty() || end < plan.range_step) {
    fill_nowhere(loss, 0, loss.transmission_loss_db.size());
    return std::nullopt;
  }
  const BandSound sound = sound_of_band(section, plan, wet.depth_m, end, progress);
  const auto rows = std::min(static_cast<std::size_t>(sound.last.pressure.rows()), plan.ranges);
  fill_nowhere(loss, rows * depths, loss.transmission_loss_db.size());
  Eigen::Array<double, 1, Eigen::Dynamic> intensity;
  for (std::size_t row = 0; row < rows; ++row) {  // all of a row at once: it stays in the nearest cache
    const auto i = static_cast<Eigen::Index>(row);
    const auto pressure = sound.last.pressure.row(i);
    if (sound.mean.size() > 0)
      intensity = sound.mean.row(i);
    else
      intensity = pressure.abs2();
    fill_nowhere(loss, row * depths, (row + 1) * depths);
    for (std::size_t j = 0; j < wet.number.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      if (!std::isfinite(intensity(column))) throw_no_number(name, (static_cast<double>(row) + 1.0) * plan.range_step, wet.depth_m[j]);
      if (!in_water(wet.depth_m[j], loss.sea_floor_depth_m[row])) continue;
      const std::size_t at = row * depths + wet.number[j];
      loss.transmission_loss_db[at] = static_cast<float>(transmission_loss(intensity(column)).value);
      if (!loss.pressure.empty()) loss.pressure[at] = pressure(column);
    }
  }
  return sound.last.grid;
}

}  // namespace earshot::sonar
