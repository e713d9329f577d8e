#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {

/// What a vehicle hears, and where.
using Measurements = std::vector<std::pair<NorthEast, Reception>>;

inline constexpr auto kTwoPerKilometre = [](double km) { return 30.0 - 2.0 * km; };

/// A belief in the small model's area, and the oceans that it is told of.
class OceanBeliefRig : public testing::Test {
 protected:
  void hear(NorthEast place, double snr_db) { belief->update(model, tables, place, {.snr = Decibels{snr_db}}); }

  void hear_all(const Measurements& measurements) {
    for (const auto& [place, reception] : measurements) belief->update(model, tables, place, reception);
  }

  [[nodiscard]] std::vector<Hypothesis> retained() const {
    std::vector<Hypothesis> all;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) all.push_back(belief->hypothesis(i));
    return all;
  }

  [[nodiscard]] int retained_that_drift() const {
    const std::vector<Hypothesis> all = retained();
    return static_cast<int>(std::count_if(all.begin(), all.end(), [](const Hypothesis& h) { return !h.drift.is_none(); }));
  }

  /// Measurements along a zigzag through the area, at what is heard in an ocean of a source: its table and 2 dB of fluctuation.
  template <class Snr>
  Measurements zigzag(int count, Snr snr_db, NorthEast source, std::uint64_t seed) const {
    Pcg32 random(seed);
    Measurements measurements;
    for (int i = 0; i < count; ++i) {
      const double side = i % 10 < 5 ? i % 5 : 5 - i % 5;
      const NorthEast place = at(400.0 * i, 2'000.0 * side);
      double normal = -6.0;
      for (int k = 0; k < 12; ++k) normal += random.uniform_double();
      measurements.push_back({place, {.snr = Decibels{snr_db(range_between(place, source).value / 1'000.0) + 2.0 * normal}}});
    }
    return measurements;
  }

  BeliefModel model = small_model();
  OceanTables tables = no_tables(kSmallRanges);
  std::unique_ptr<OceanBelief> belief = std::make_unique<OceanBelief>();
};

/// Where the source is after so many measurements that began in a cell of the small model, written out; a sixteenth of a step length
/// is 62.5 m.
inline NorthEast drifted(const Drift& drift, int measurements, std::size_t cell) {
  const auto along = [&](double place, int parts) {
    place += 62.5 * parts * measurements;
    while (!drift.is_current && (place < 0.0 || place > 10'000.0)) place = place < 0.0 ? -place : 20'000.0 - place;
    return place;
  };
  return at(along(500.0 * (static_cast<double>(cell / 20) + 0.5), drift.north),
            along(500.0 * (static_cast<double>(cell % 20) + 0.5), drift.east));
}

/// Cell of the small model that holds a place; of one outside the nearest.
inline std::size_t cell_at(NorthEast place) {
  const auto index = [](Meters x) { return static_cast<std::size_t>(std::clamp(std::floor(x.value / 500.0), 0.0, 19.0)); };
  return index(place.north) * 20 + index(place.east);
}

/// The current that has the largest share; none where none has it.
inline Drift likeliest_current(const OceanBelief& belief) {
  std::map<std::tuple<int, int>, double> shares;
  for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
    const Drift& drift = belief.hypothesis(i).drift;
    shares[drift.is_current ? std::tuple{int{drift.north}, int{drift.east}} : std::tuple{0, 0}] += double{belief.share(i)};
  }
  const auto best = std::max_element(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto [north, east] = best->first;
  return {static_cast<std::int8_t>(north), static_cast<std::int8_t>(east), north != 0 || east != 0};
}

/// 2 pi times the wrapped normal distribution, by its Fourier series.
inline double wrapped(double off, double deviation) {
  double sum = 1.0;
  for (int k = 1; k < 200; ++k) sum += 2.0 * std::exp(-0.5 * k * k * deviation * deviation) * std::cos(k * off);
  return sum;
}

/// Likelihood times 2 pi of a bearing, were the source in a cell of that middle: 2 % are outliers, and a cell is seen at an angle.
inline double bearing_likelihood_by_hand(NorthEast vehicle, const messages::Bearing& bearing, NorthEast middle) {
  const double north_m = (middle.north - vehicle.north).value;
  const double east_m = (middle.east - vehicle.east).value;
  const double smear = 500.0 / std::hypot(north_m, east_m) / std::sqrt(12.0);
  return 0.98 * wrapped(std::atan2(east_m, north_m) - bearing.direction.value, std::hypot(bearing.deviation.value, smear)) + 0.02;
}

/// The same in a cell of the small model.
inline double bearing_likelihood_by_hand(NorthEast vehicle, const messages::Bearing& bearing, std::size_t cell) {
  return bearing_likelihood_by_hand(vehicle, bearing, drifted({}, 0, cell));
}

}  // namespace earshot::policy
