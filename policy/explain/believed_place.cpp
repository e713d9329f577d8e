#include "policy/explain/believed_place.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace earshot::explain {
namespace {

/// Second moments of the place about its mean, square metres.
struct Covariance {
  double north = 0.0;
  double north_east = 0.0;
  double east = 0.0;
};

/// Source: the eigenvalues and the principal direction of a symmetric 2 x 2 matrix.
SpreadEllipse ellipse_of(const Covariance& c) {
  const double middle = 0.5 * (c.north + c.east);
  const double half_gap = std::hypot(0.5 * (c.north - c.east), c.north_east);
  double bearing = 0.5 * std::atan2(2.0 * c.north_east, c.north - c.east);
  if (bearing < 0.0) bearing += std::numbers::pi;
  return {.semi_major = Meters{std::sqrt(middle + half_gap)},
          .semi_minor = Meters{std::sqrt(std::max(0.0, middle - half_gap))},
          .bearing = Radians{bearing}};
}

std::vector<std::size_t> likeliest_first(const std::vector<double>& probability) {
  std::vector<std::size_t> order(probability.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return probability[a] > probability[b]; });
  return order;
}

std::vector<double> ranks(const std::vector<double>& probability) {
  std::vector<double> rank(probability.size());
  double sum = 0.0;
  for (const std::size_t cell : likeliest_first(probability)) rank[cell] = sum += probability[cell];
  return rank;
}

template <class Visit>
void for_each_cell(const BelievedPlace& place, Visit visit) {
  for (std::size_t i = 0; i < place.cells_north; ++i) {
    for (std::size_t j = 0; j < place.cells_east; ++j) visit(place.centre(i, j), place.probability[i * place.cells_east + j]);
  }
}

}  // namespace

NorthEast BelievedPlace::centre(std::size_t north, std::size_t east) const {
  return {area_size.north * ((static_cast<double>(north) + 0.5) / static_cast<double>(cells_north)),
          area_size.east * ((static_cast<double>(east) + 0.5) / static_cast<double>(cells_east))};
}

double BelievedPlace::smallest_area_km2(double share) const {
  const double cell_km2 = area_size.north.value * area_size.east.value / static_cast<double>(probability.size()) * 1e-6;
  double sum = 0.0;
  double area = 0.0;
  for (const std::size_t cell : likeliest_first(probability)) {
    if (sum >= share) break;
    sum += probability[cell];
    area += cell_km2;
  }
  return area;
}

BelievedPlace believed_place(const policy::OceanBelief& belief, const policy::BeliefModel& model) {
  BelievedPlace place;
  place.area_size = model.area_size;
  place.cells_north = model.cells_north;
  place.cells_east = model.cells_east;
  for (std::size_t i = 0; i < place.cells_north; ++i) {
    for (std::size_t j = 0; j < place.cells_east; ++j) place.probability.push_back(static_cast<double>(belief.probability(model, i, j)));
  }
  const double sum = std::accumulate(place.probability.begin(), place.probability.end(), 0.0);  // 1 but for float's rounding
  for (double& p : place.probability) p /= sum;
  place.rank = ranks(place.probability);
  const auto top = std::ranges::max_element(place.probability);
  const auto cell = static_cast<std::size_t>(top - place.probability.begin());
  place.likeliest = place.centre(cell / place.cells_east, cell % place.cells_east);
  place.likeliest_share = *top;
  for_each_cell(place, [&](NorthEast centre, double p) { place.mean = place.mean + NorthEast{p * centre.north, p * centre.east}; });
  Covariance covariance;
  for_each_cell(place, [&](NorthEast centre, double p) {
    const NorthEast off = centre - place.mean;
    covariance.north += p * off.north.value * off.north.value;
    covariance.north_east += p * off.north.value * off.east.value;
    covariance.east += p * off.east.value * off.east.value;
  });
  place.ellipse = ellipse_of(covariance);
  return place;
}

Meters expected_approach(const BelievedPlace& place, NorthEast from, NorthEast to) {
  Meters sum;
  for_each_cell(place, [&](NorthEast centre, double p) { sum += p * (range_between(centre, from) - range_between(centre, to)); });
  return sum;
}

ExpectedSound::ExpectedSound(const policy::OceanBelief& belief, const policy::OceanTables& tables)
    : range_step_(tables.range_step), snr_db_(tables.range_count, 0.0) {
  for (std::size_t h = 0; h < policy::OceanBelief::kHypotheses; ++h) {
    const policy::Hypothesis& hypothesis = belief.hypothesis(h);
    const double share = static_cast<double>(belief.share(h));
    const double level_db = static_cast<double>(policy::kLevelOffsets_db[hypothesis.level]);
    level_db_ += share * level_db;
    for (std::size_t r = 0; r < snr_db_.size(); ++r)
      snr_db_[r] += share * (static_cast<double>(tables.tables[hypothesis.table].snr_db(r)) + level_db);
  }
}

double ExpectedSound::snr_db(Meters range) const {
  const double at = range / range_step_;
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= snr_db_.size()) return snr_db_.back();
  return std::lerp(snr_db_[below], snr_db_[below + 1], at - static_cast<double>(below));
}

ExpectedHearing expected_hearing(const BelievedPlace& place, const ExpectedSound& sound, NorthEast at) {
  double mean = 0.0;
  double square = 0.0;
  for_each_cell(place, [&](NorthEast centre, double p) {
    const double snr = sound.snr_db(range_between(centre, at));
    mean += p * snr;
    square += p * snr * snr;
  });
  return {
      .snr = Decibels{mean}, .spread = Decibels{std::sqrt(std::max(0.0, square - mean * mean))}, .level_bias = Decibels{sound.level_db()}};
}

}  // namespace earshot::explain
