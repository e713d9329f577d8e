#include "sim/sonar/sonar_field.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sim/ocean/section_along.hpp"
#include "sim/pe/grid_choice.hpp"
#include "sim/sonar/sonar_equation.hpp"

namespace earshot::sonar {

float SonarField::snr_db(std::size_t range, std::size_t depth) const {
  const float loss_db = at(range, depth);
  if (std::isnan(loss_db)) return loss_db;  // no water
  return static_cast<float>(signal_to_noise(source_level, Decibels{static_cast<double>(loss_db)}, noise_level).value);
}

std::optional<std::string> doubt_of(const SonarField& field, Decibels accuracy) {
  return field.grid ? pe::doubt_of(field.grid->predicted_error_db, accuracy) : std::nullopt;
}

std::vector<float> rounded_loss_db(std::vector<float> loss_db) {
  for (float& loss : loss_db) loss = std::nearbyint(loss * 256.0F) / 256.0F;
  return loss_db;
}

std::vector<float> rounded_snr_db(const SonarField& field) {
  std::vector<float> level_db = rounded_loss_db(field.transmission_loss_db);
  for (float& level : level_db) level = static_cast<float>(field.source_level.value - static_cast<double>(level) - field.noise_level.value);
  return level_db;
}

SonarField compute_sonar_field(const ocean::Environment& environment, const ocean::Section& section, const RadialPlan& plan,
                               const pe::Progress& progress, Pressure pressure) {
  SonarField result{.range_m = {},
                    .depth_m = plan.depth_m,
                    .source_level = environment.source.level,
                    .noise_level = environment.noise_level,
                    .transmission_loss_db = std::vector<float>(plan.ranges * plan.depth_m.size()),
                    .sea_floor_depth_m = std::vector<float>(plan.ranges),
                    .unmeasured = section.unmeasured};
  for (std::size_t i = 0; i < plan.ranges; ++i) result.range_m.push_back(static_cast<double>(i + 1) * plan.range_step.value);
  if (pressure == Pressure::kKept) result.pressure.resize(result.transmission_loss_db.size());
  result.grid = compute_radial(
      section, environment.name, plan,
      {.transmission_loss_db = result.transmission_loss_db, .sea_floor_depth_m = result.sea_floor_depth_m, .pressure = result.pressure},
      progress);
  return result;
}

namespace {

void require_receiver_in_water(const std::string& name, Meters receiver_depth, Meters floor) {
  if (receiver_depth < floor) return;
  std::ostringstream text;
  text << name << ": a receiver at " << receiver_depth.value << " m must be above the sea floor, which lies at " << floor.value
       << " m in this ocean";
  throw std::invalid_argument(text.str());
}

}  // namespace

SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters receiver_depth, Meters max_range) {
  if (differs_with_place(environment)) {
    throw std::invalid_argument(environment.name +
                                ": its ocean differs from bearing to bearing; one curve of SNR against range does not describe it");
  }
  const ocean::Section section = ocean::section_along(environment, environment.source.position, Radians{}, max_range);
  require_receiver_in_water(environment.name, receiver_depth, deepest_sea_floor(section, max_range));
  constexpr Meters kStep{10.0};  // at 20 Hz the shortest interference along the range is 75 m long
  const RadialPlan plan{.source_depth = environment.source.depth,
                        .depth_m = {receiver_depth.value},
                        .range_step = kStep,
                        .ranges = std::max<std::size_t>(1, static_cast<std::size_t>(max_range / kStep + 1e-9)),
                        .band = {environment.source.frequency, environment.source.frequency}};
  const SonarField field = compute_sonar_field(environment, section, plan);
  const auto silence = static_cast<float>(signal_to_noise(environment.source.level, kMaxTransmissionLoss, environment.noise_level).value);
  std::vector<float> snr_db{0.0F};
  for (std::size_t i = 0; i < field.range_m.size(); ++i) {
    const float snr = field.snr_db(i, 0);
    snr_db.push_back(std::isnan(snr) ? silence : snr);
  }
  snr_db.front() = snr_db[1];
  return SnrCurve{kStep, std::move(snr_db)};
}

}  // namespace earshot::sonar
