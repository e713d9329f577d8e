#include <algorithm>
#include <array>
#include <limits>

#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"

namespace earshot::policy {
namespace {

/// One of eight drifts takes so much longer; with a bearing, which is laid over the cells of each of them, so much.
constexpr std::size_t kMeasurementsOfDrifts = 2;
constexpr std::size_t kMeasurementsOfDriftsWithBearing = 8;
/// Of those that are held so many drift, once there are any.
constexpr std::size_t kLeastThatDrift = 8;
/// Before so many measurements nothing tells a drift from another place: what is tried until then are oceans. Bearings tell it earlier.
constexpr std::uint32_t kMeasurementsBeforeDrifts = 8;
constexpr std::uint32_t kMeasurementsBeforeDriftsWithBearings = 4;
static_assert(kLeastThatDrift < OceanBelief::kHypotheses);
/// log2 of 1 / (spread sqrt(2 pi)), the most that a normal density of each spread comes to, in 1/512; a unit more, for they are rounded.
constexpr std::array<int, kSpreads_db.size()> kMostLikely{-678, -1'190, -1'702, -2'115};
/// Less likely than any.
constexpr int kNoPosterior = std::numeric_limits<int>::min() / 2;

}  // namespace

/// None of eight is weighed any longer than it can still be held.
bool OceanBelief::refine(const BeliefModel& model, const OceanTables& tables) {
  if (silence_.is_behind()) {
    silence_.catch_up(model, tables);
    return to_weigh_ > 0;
  }
  const auto is_measured = [](const Measurement& measurement) { return !measurement.too_faint; };
  for (std::size_t slice = config::kMeasurementsInASlice; slice > 0 && to_weigh_ > 0;) {
    if (!has_candidates_) draw_candidates(model, tables);
    const bool drift = !candidates_.hypothesis(0).drift.is_none();
    const int least = least_to_be_held(drift);
    int to_measure = static_cast<int>(std::count_if(measurements_.begin() + candidates_heard_, measurements_.end(), is_measured));
    while (slice > 0 && to_weigh_ > 0 && has_candidates_ && candidates_heard_ < measurements_.size()) {
      const std::uint32_t index = candidates_heard_++;
      const Measurement& measurement = measurements_[index];
      candidates_.let_move(model);
      if (drift && measurement.bearing.is_there()) take_in_past_bearing(model, measurement, index);
      take_in(model, tables, measurement, index, candidates_);
      const std::size_t cost = !drift ? 1 : measurement.bearing.is_there() ? kMeasurementsOfDriftsWithBearing : kMeasurementsOfDrifts;
      slice -= std::min(slice, cost);
      to_weigh_ -= std::min(to_weigh_, cost);
      to_measure -= is_measured(measurement) ? 1 : 0;
      has_candidates_ = most_to_come(model, tables, to_measure) >= least;
    }
    if (!has_candidates_) continue;
    if (candidates_heard_ < measurements_.size()) break;  // the next slice goes on
    take_the_likelier(model, tables);
    has_candidates_ = false;
  }
  return to_weigh_ > 0;
}

HeldHypotheses OceanBelief::held() const {
  HeldHypotheses held;
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    held.hypotheses[i] = hypothesis(i);
    held.shares[i] = share(i);
  }
  return held;
}

/// Those that rest start with all that bearings have said; those that drift hear them one by one, from where they were.
void OceanBelief::draw_candidates(const BeliefModel& model, const OceanTables& tables) {
  const HeldHypotheses all = held();
  Trial trial = draw_trial(all, random_);
  const bool is_too_early = heard_ < (has_bearings_ ? kMeasurementsBeforeDriftsWithBearings : kMeasurementsBeforeDrifts);
  if (is_too_early && trial == Trial::kDrifting) trial = Trial::kAtRest;
  const std::array<Hypothesis, kLanes> drawn = policy::draw_candidates(all, tables, trial, random_);
  trial == Trial::kDrifting ? candidates_.start(model, drawn) : candidates_.start(model, drawn, bearings_);
  candidates_heard_ = 0;
  has_candidates_ = true;
}

bool OceanBelief::is_held(const Hypothesis& hypothesis) const {
  return std::any_of(retained_.begin(), retained_.end(), [&](const HypothesisBlock& block) { return block.holds(hypothesis); });
}

std::size_t OceanBelief::drifting() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kHypotheses; ++i) count += hypothesis(i).drift.is_none() ? 0U : 1U;
  return count;
}

/// Of those that are held and may give way. A few that drift are held however unlikely they are: a drift is found by way of others that
/// are near it.
/// @param drifts  what would take its place
std::size_t OceanBelief::least_likely(bool drifts) const {
  const std::size_t count = drifting();
  const bool may_drift = count > kLeastThatDrift || (drifts && count == kLeastThatDrift);
  std::size_t least = kHypotheses;
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    if (!hypothesis(i).drift.is_none() && !may_drift) continue;
    if (least == kHypotheses || posterior(i) < posterior(least)) least = i;
  }
  return least;
}

/// Posterior beyond which a candidate is held. @param drifts  it does
int OceanBelief::least_to_be_held(bool drifts) const {
  return drifts && drifting() < kLeastThatDrift ? kNoPosterior : posterior(least_likely(drifts));
}

int OceanBelief::posterior_of_likeliest() const {
  int most = kNoPosterior;
  for (std::size_t i = 0; i < kHypotheses; ++i) most = std::max(most, posterior(i));
  return most;
}

/// No candidate's posterior comes to more, however well it explains what it has still to hear.
/// @param to_measure  measurements among that which were measured
int OceanBelief::most_to_come(const BeliefModel& model, const OceanTables& tables, int to_measure) const {
  int most = kNoPosterior;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Hypothesis& h = candidates_.hypothesis(l);
    most = std::max(most, candidates_.log_of_likeliest(l) + log_prior(h, tables) + to_measure * tempered(kMostLikely[h.spread]));
  }
  return most + to_log(static_cast<float>(cell_count(model)));
}

void OceanBelief::take_the_likelier(const BeliefModel& model, const OceanTables& tables) {
  const std::array<int, kLanes> evidence = candidates_.log_evidence(model);
  for (std::size_t c = 0; c < kLanes; ++c) {
    const Hypothesis& candidate = candidates_.hypothesis(c);
    if (is_held(candidate)) continue;
    const bool drifts = !candidate.drift.is_none();
    const int of_candidate = evidence[c] + log_prior(candidate, tables);
    if (of_candidate <= least_to_be_held(drifts)) continue;
    const std::size_t least = least_likely(drifts);
    retained_[least / kLanes].take_over(model, least % kLanes, candidates_, c);
    posteriors_[least / kLanes][least % kLanes] = of_candidate;
  }
  find_shares();
}

}  // namespace earshot::policy
