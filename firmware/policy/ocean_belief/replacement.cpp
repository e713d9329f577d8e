#include "firmware/policy/ocean_belief/replacement.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "firmware/policy/ocean_belief/hypotheses/candidates.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// Past measurements that blocks of eight candidates take in, at most, between two measurements of the vehicle. With 50 fewer sources are
/// found, with 400 no more than with 200 (policy/experiments/ocean_belief.md).
constexpr std::size_t kMeasurementsOfOthers = 200;
/// A measurement that eight drifts take in costs as much as so many that eight at rest do.
constexpr std::size_t kMeasurementsOfDrifts = 2;
/// Likewise, with a bearing, which is weighed in the cells of each drift.
constexpr std::size_t kMeasurementsOfDriftsWithBearing = 8;
/// Before so many measurements nothing tells a drift from another place: what is tried until then are oceans. Bearings tell it earlier.
constexpr std::uint32_t kMeasurementsBeforeDrifts = 8;
constexpr std::uint32_t kMeasurementsBeforeDriftsWithBearings = 4;
/// log2 of 1 / (spread sqrt(2 pi)), the most that a normal density of each spread comes to, in 1/512; a unit more, for they are rounded.
constexpr std::array<int, kSpreads_db.size()> kMostLikely{-678, -1'190, -1'702, -2'115};

}  // namespace

void Replacement::start() {
  random_ = Pcg32(1);
  has_candidates_ = false;
  to_weigh_ = 0;
}

void Replacement::begin(const MeasurementHistory& history) {
  to_weigh_ = history.is_whole() ? kMeasurementsOfOthers : 0;
}

/// None of eight is weighed any longer than it can still be retained.
void Replacement::weigh_slice(const Assumptions& assumed, const MeasurementHistory& history, const BearingSum& bearings,
                              MeasurementWeigher& weigher, RetainedHypotheses& retained) {
  const auto is_measured = [](const Measurement& measurement) { return !measurement.too_faint; };
  const std::span<const Measurement> measurements = history.measurements();
  for (std::size_t slice = config::kMeasurementsInASlice; slice > 0 && to_weigh_ > 0;) {
    if (!has_candidates_) draw(assumed, history, bearings, retained);
    const bool drift = are_drifting();
    const int least = retained.least_to_be_retained(drift);
    int to_measure = static_cast<int>(std::count_if(measurements.begin() + weighed_, measurements.end(), is_measured));
    while (slice > 0 && to_weigh_ > 0 && has_candidates_ && weighed_ < measurements.size()) {
      const std::uint32_t index = weighed_++;
      const Measurement& measurement = measurements[index];
      candidates_.let_move(assumed.model);
      if (drift && measurement.bearing.is_there())
        weigh_by_bearing(assumed.model, measurement, index, weigher.bearing_weights(assumed.model, measurement), candidates_);
      weigher.weigh(assumed, measurement, index, candidates_);
      const std::size_t cost = !drift ? 1 : measurement.bearing.is_there() ? kMeasurementsOfDriftsWithBearing : kMeasurementsOfDrifts;
      slice -= std::min(slice, cost);
      to_weigh_ -= std::min(to_weigh_, cost);
      to_measure -= is_measured(measurement) ? 1 : 0;
      has_candidates_ = most_to_come(assumed, to_measure) >= least;
    }
    if (!has_candidates_) continue;
    if (weighed_ < measurements.size()) break;  // the next slice goes on
    retained.take_the_likelier(assumed, candidates_);
    has_candidates_ = false;
  }
}

void Replacement::take_in_bearing(const BeliefModel& model, const Measurement& measurement, std::uint32_t index,
                                  const BearingWeights& weights) {
  if (has_candidates_ && !are_drifting()) weigh_by_bearing(model, measurement, index, weights, candidates_);
}

/// Those that rest start with the sum of all bearings; those that drift are weighed by them one by one, from where they were.
void Replacement::draw(const Assumptions& assumed, const MeasurementHistory& history, const BearingSum& bearings,
                       const RetainedHypotheses& retained) {
  const RetainedShares all = retained.with_shares();
  Trial trial = draw_trial(all, random_);
  const bool is_too_early = history.count() < (bearings.is_empty() ? kMeasurementsBeforeDrifts : kMeasurementsBeforeDriftsWithBearings);
  if (is_too_early && trial == Trial::kDrifting) trial = Trial::kAtRest;
  const std::array<Hypothesis, kLanes> drawn = draw_candidates(all, assumed.tables, trial, random_);
  trial == Trial::kDrifting ? candidates_.start(assumed.model, drawn) : candidates_.start(assumed.model, drawn, bearings.sum());
  weighed_ = 0;
  has_candidates_ = true;
}

/// No candidate's posterior comes to more, however well it explains the measurements that are left.
/// @param to_measure  how many of these were not too faint
int Replacement::most_to_come(const Assumptions& assumed, int to_measure) const {
  int most = kNoPosterior;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Hypothesis& h = candidates_.hypothesis(l);
    most = std::max(most, candidates_.log_of_likeliest(l) + log_prior(h, assumed.tables) + to_measure * tempered(kMostLikely[h.spread]));
  }
  return most + to_log(static_cast<float>(cell_count(assumed.model)));
}

}  // namespace earshot::policy
