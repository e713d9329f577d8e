#include "firmware/policy/ocean_belief/hypotheses/retained_hypotheses.hpp"

#include <algorithm>

#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// Powers of two below the likeliest at which a hypothesis has no share.
constexpr int kMostBelowLikeliest = 60 * kOctave;
/// So many of the retained hypotheses drift, once any does.
constexpr std::size_t kLeastThatDrift = 8;
static_assert(kLeastThatDrift < kRetainedHypotheses);

/// The n-th to begin with, the likeliest first: all oceans as they are, then louder, fainter, and so on; fit for more than are ever
/// retained.
Hypothesis at_start(const OceanTables& tables, std::size_t n) {
  constexpr std::array<std::uint8_t, kLevelOffsets_db.size()> kLevels{3, 5, 1, 4, 2, 6, 0};
  constexpr std::array<std::uint8_t, kSpreads_db.size()> kSpreads{2, 1, 3, 0};
  static_assert(kLevels.size() * kSpreads.size() >= kRetainedHypotheses, "even with one ocean");
  const std::size_t way = n / tables.tables.size();
  return {.table = static_cast<std::uint8_t>(n % tables.tables.size()),
          .level = kLevels[way % kLevels.size()],
          .spread = kSpreads[way / kLevels.size() % kSpreads.size()]};
}

}  // namespace

void RetainedHypotheses::start(const Assumptions& assumed, const PlacePrior& prior) {
  const OceanTables& tables = assumed.tables;
  std::uint8_t likeliest = 0;
  for (std::uint8_t k = 0; k < tables.tables.size(); ++k)
    likeliest = tables.tables[k].prior > tables.tables[likeliest].prior ? k : likeliest;
  std::array<Hypothesis, kLanes> hypotheses;
  hypotheses.fill({.table = likeliest});
  hypotheses[1].spread = 1;
  hypotheses[2].spread = 0;
  hypotheses[3].level = 1;
  hypotheses[4].level = 5;
  hypotheses[5].silence = 1;
  hypotheses[6].mobility = 1;
  hypotheses[7].spread = 3;
  for (HypothesisBlock& block : blocks_) block.start(assumed.model, hypotheses, prior);
  std::size_t next = 0;
  for (std::size_t b = 1; b < blocks_.size(); ++b) {
    for (Hypothesis& h : hypotheses) {
      do h = at_start(tables, next++);
      while (blocks_[0].holds(h));  // one that is retained twice would count twice
    }
    blocks_[b].start(assumed.model, hypotheses, prior);
  }
  find_shares(assumed);
}

void RetainedHypotheses::find_shares(const Assumptions& assumed) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    posteriors_[b] = blocks_[b].log_evidence(assumed.model);
    for (std::size_t l = 0; l < kLanes; ++l) posteriors_[b][l] += log_prior(blocks_[b].hypothesis(l), assumed.tables);
  }
  share_out();
}

/// Finds the shares by the posteriors.
void RetainedHypotheses::share_out() {
  int highest = kNoPosterior;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) highest = std::max(highest, posterior(i));
  float sum = 0.0F;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      shares_[b][l] = from_log(std::max(posteriors_[b][l] - highest, -kMostBelowLikeliest));
      sum += shares_[b][l];
    }
  }
  for (FloatLanes& shares : shares_) {
    for (float& share : shares) share /= sum;
  }
}

RetainedShares RetainedHypotheses::with_shares() const {
  RetainedShares retained;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    retained.hypotheses[i] = hypothesis(i);
    retained.shares[i] = share(i);
  }
  return retained;
}

bool RetainedHypotheses::holds(const Hypothesis& hypothesis) const {
  return std::any_of(blocks_.begin(), blocks_.end(), [&](const HypothesisBlock& block) { return block.holds(hypothesis); });
}

std::size_t RetainedHypotheses::drifting() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) count += hypothesis(i).drift.is_none() ? 0U : 1U;
  return count;
}

/// Of those that may be replaced. A few that drift are retained however unlikely they are: a drift is found by way of others that are near
/// it.
/// @param drifts  whether what would take its place does
std::size_t RetainedHypotheses::least_likely(bool drifts) const {
  const std::size_t count = drifting();
  const bool may_drift = count > kLeastThatDrift || (drifts && count == kLeastThatDrift);
  std::size_t least = kRetainedHypotheses;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    if (!hypothesis(i).drift.is_none() && !may_drift) continue;
    if (least == kRetainedHypotheses || posterior(i) < posterior(least)) least = i;
  }
  return least;
}

int RetainedHypotheses::least_to_be_retained(bool drifts) const {
  return drifts && drifting() < kLeastThatDrift ? kNoPosterior : posterior(least_likely(drifts));
}

void RetainedHypotheses::take_the_likelier(const Assumptions& assumed, const HypothesisBlock& candidates) {
  const std::array<int, kLanes> evidence = candidates.log_evidence(assumed.model);
  for (std::size_t c = 0; c < kLanes; ++c) {
    const Hypothesis& candidate = candidates.hypothesis(c);
    if (holds(candidate)) continue;
    const bool drifts = !candidate.drift.is_none();
    const int of_candidate = evidence[c] + log_prior(candidate, assumed.tables);
    if (of_candidate <= least_to_be_retained(drifts)) continue;
    const std::size_t least = least_likely(drifts);
    blocks_[least / kLanes].take_over(assumed.model, least % kLanes, candidates, c);
    posteriors_[least / kLanes][least % kLanes] = of_candidate;
  }
  share_out();
}

Drift RetainedHypotheses::likeliest_current() const {
  float most = 0.0F;
  Drift likeliest;
  for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
    const Drift current = current_of(hypothesis(i));
    std::size_t first = 0;
    while (!(current_of(hypothesis(first)) == current)) ++first;
    if (first < i) continue;  // it has been summed up
    float sum = 0.0F;
    for (std::size_t k = i; k < kRetainedHypotheses; ++k) sum += current_of(hypothesis(k)) == current ? share(k) : 0.0F;
    if (sum > most) likeliest = current;
    most = std::max(most, sum);
  }
  return likeliest;
}

void RetainedHypotheses::find_marginal(const BeliefModel& model, NorthEast corner, std::uint32_t measurements, const CellWindow& window,
                                       std::span<float> marginal) const {
  bool is_first = true;
  const auto clear = [&] {
    if (is_first) std::fill(marginal.begin(), marginal.end(), 0.0F);
    is_first = false;
  };
  if (window != all_cells(model)) clear();
  CellPlaces places;
  std::array<std::uint16_t, CellPlaces::kMostAxes> axes;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    FloatLanes at_rest{};
    float most_at_rest = 0.0F;
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Drift& drift = blocks_[b].hypothesis(l).drift;
      if (drift.is_none() && corner == NorthEast{}) {
        at_rest[l] = shares_[b][l];
        most_at_rest = std::max(most_at_rest, at_rest[l]);
      } else if (shares_[b][l] >= kLeastShare) {
        places.find(model, drift, measurements, corner);
        places.find_axes(model, axes);
        clear();
        blocks_[b].add_to(model, l, shares_[b][l], axes, window, marginal);
      }
    }
    if (most_at_rest < kLeastShare) continue;
    blocks_[b].add_to(model, at_rest, window, is_first, marginal);
    is_first = false;
  }
  clear();
}

void RetainedHypotheses::add_joint(const BeliefModel& model, std::size_t index, std::uint32_t measurements, std::span<float> joint) const {
  CellPlaces places;
  std::array<std::uint16_t, CellPlaces::kMostAxes> axes;
  places.find(model, hypothesis(index).drift, measurements, {});
  places.find_axes(model, axes);
  blocks_[index / kLanes].add_to(model, index % kLanes, share(index), axes, all_cells(model), joint);
}

std::uint32_t RetainedHypotheses::fingerprint(const BeliefModel& model, std::uint32_t crc) const {
  for (const HypothesisBlock& block : blocks_) crc = block.fingerprint(model, crc);
  return crc;
}

}  // namespace earshot::policy
