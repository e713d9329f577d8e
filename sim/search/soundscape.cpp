#include "sim/search/soundscape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/sonar/sonar_field.hpp"

namespace earshot::search {

Soundscape::Soundscape(std::vector<sonar::SnrCurve> curves) : curves_(std::move(curves)) {
  assert(!curves_.empty());
}

Soundscape::Soundscape(sonar::SnrCurve expected, std::vector<SnrFan> fans) : curves_{std::move(expected)}, fans_(std::move(fans)) {
  assert(!fans_.empty());
}

std::size_t Soundscape::field_of(std::size_t ocean, NorthEast source) const {
  if (fans_.empty()) return ocean;
  const auto nearest = std::ranges::min_element(fans_, {}, [source](const SnrFan& f) { return range_between(f.fan.centre, source); });
  return static_cast<std::size_t>(nearest - fans_.begin());
}

Decibels Soundscape::snr(std::size_t field, NorthEast source, NorthEast receiver) const {
  if (fans_.empty()) return curves_[field].at(range_between(receiver, source));
  const SnrFan& f = fans_[field];
  const double loss_db = f.fan.transmission_loss_at(f.fan.centre + (receiver - source), 0);
  const Decibels loss = std::isnan(loss_db) ? sonar::kMaxTransmissionLoss : Decibels{loss_db};
  return f.source_level - loss - f.noise_level;
}

Soundscape soundscape_of(const ocean::Environment& environment, Meters vehicle_depth, Meters furthest) {
  std::vector<sonar::SnrCurve> curves{sonar::compute_snr_curve(environment, vehicle_depth, furthest)};
  for (const ocean::Environment& other : environment.other_oceans)
    curves.push_back(sonar::compute_snr_curve(other, vehicle_depth, furthest));
  return Soundscape(std::move(curves));
}

}  // namespace earshot::search
