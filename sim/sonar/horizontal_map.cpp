#include "sim/sonar/horizontal_map.hpp"

namespace earshot::sonar {
namespace {

std::vector<double> axis_m(Meters centre, const MapGrid& grid) {
  std::vector<double> values;
  for (std::size_t i = 0; i <= grid.intervals; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(grid.intervals) - 0.5;
    values.push_back(centre.value + share * grid.side.value);
  }
  return values;
}

}  // namespace

HorizontalMap make_map(const Fan& fan, std::size_t depth, const MapGrid& grid, const Detector& detector, const pe::Progress& progress) {
  HorizontalMap map{
      .north_m = axis_m(fan.centre.north, grid), .east_m = axis_m(fan.centre.east, grid), .snr_db = {}, .detection_probability = {}};
  for (const double north : map.north_m) {
    if (progress) progress(static_cast<double>(map.snr_db.size()) / static_cast<double>(map.north_m.size() * map.east_m.size()));
    for (const double east : map.east_m) {
      const Decibels snr = detector.snr(Decibels{fan.transmission_loss_at({Meters{north}, Meters{east}}, depth)});
      map.snr_db.push_back(static_cast<float>(snr.value));
      map.detection_probability.push_back(static_cast<float>(detection_probability(snr, detector)));
    }
  }
  return map;
}

}  // namespace earshot::sonar
