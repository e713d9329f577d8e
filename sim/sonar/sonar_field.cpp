#include "sim/sonar/sonar_field.hpp"

#include <algorithm>
#include <cmath>

#include "sim/sonar/sonar_equation.hpp"

namespace earshot::sonar {

Decibels transmission_loss(std::complex<double> pressure) {
  // Written so that zero pressure, infinite loss, ends at the cap.
  return Decibels{std::min(-20.0 * std::log10(std::abs(pressure)), kMaxTransmissionLoss.value)};
}

SonarField compute_sonar_field(const ocean::Environment& environment, const pe::Options& options,
                               const std::vector<double>& receiver_depth_m, Meters max_range, const pe::Progress& progress) {
  const pe::Field field = pe::solve(environment, options, receiver_depth_m, max_range, progress);
  SonarField result{.range_m = {}, .depth_m = field.depth_m, .transmission_loss_db = {}, .snr_db = {}};
  for (Eigen::Index row = 0; row < field.pressure.rows(); ++row)
    result.range_m.push_back(static_cast<double>(row + 1) * field.range_step.value);
  result.transmission_loss_db =
      field.pressure.unaryExpr([](std::complex<double> p) { return static_cast<float>(transmission_loss(p).value); });
  result.snr_db = result.transmission_loss_db.unaryExpr([&environment](float loss_db) {
    const auto snr = signal_to_noise(environment.source.level, Decibels{static_cast<double>(loss_db)}, environment.noise_level);
    return static_cast<float>(snr.value().value);
  });
  return result;
}

SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters receiver_depth, Meters max_range) {
  constexpr Meters kStep{10.0};  // at 20 Hz the shortest interference along the range is 75 m long
  const SonarField field =
      compute_sonar_field(environment, {.depth_step = {}, .range_step = {}, .output_step = kStep}, {receiver_depth.value}, max_range);
  std::vector<float> snr_db{field.snr_db(0, 0)};
  for (Eigen::Index row = 0; row < field.snr_db.rows(); ++row) snr_db.push_back(field.snr_db(row, 0));
  return SnrCurve{kStep, std::move(snr_db)};
}

}  // namespace earshot::sonar
