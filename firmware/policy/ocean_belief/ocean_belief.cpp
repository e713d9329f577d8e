#include "firmware/policy/ocean_belief/ocean_belief.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/belief_summary.hpp"
#include "firmware/policy/likelihood/bearing_likelihood.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/likelihood/normal_table.hpp"
#include "firmware/policy/ocean_belief/log_weight.hpp"

namespace earshot::policy {
namespace {

/// Looks of a block of other hypotheses that are taken in after each look of the vehicle: as many as the time of a decision allows.
constexpr std::size_t kLooksOfOthers = 50;
/// Of so many blocks of other hypotheses one has sources that may move.
constexpr std::uint32_t kDrawsPerMoving = 4;
/// Draws of one other hypothesis before one that is held already is taken again.
constexpr int kDraws = 8;
/// A hypothesis less likely than this changes no decision.
constexpr float kLeastShare = 1e-4F;
/// Less likely than any.
constexpr int kNoPosterior = std::numeric_limits<int>::min() / 2;
/// Powers of two below the likeliest at which a hypothesis has no share.
constexpr int kMostBelow = 60 * kOctave;

/// Scales log weights so that the highest is 0 and none below kForgotten. @return what was taken off them
int take_off_highest(std::span<std::int16_t> weights) {
  const int highest = *std::max_element(weights.begin(), weights.end());
  for (std::int16_t& weight : weights) weight = static_cast<std::int16_t>(std::max<int>(weight - highest, kForgotten));
  return highest;
}

/// The n-th to begin with, the likeliest first: all oceans as they are, then louder, fainter, and so on; fit for more than are ever held.
Hypothesis at_start(const OceanTables& tables, std::size_t n) {
  constexpr std::array<std::uint8_t, kLevelOffsets_db.size()> kLevels{3, 5, 1, 4, 2, 6, 0};
  constexpr std::array<std::uint8_t, kSpreads_db.size()> kSpreads{2, 1, 3, 0};
  static_assert(kLevels.size() * kSpreads.size() >= OceanBelief::kHypotheses, "even with one ocean");
  const std::size_t way = n / tables.tables.size();
  return {.table = static_cast<std::uint8_t>(n % tables.tables.size()),
          .level = kLevels[way % kLevels.size()],
          .spread = kSpreads[way / kLevels.size() % kSpreads.size()]};
}

}  // namespace

void OceanBelief::start(const BeliefModel& model, const OceanTables& tables) {
  random_ = Pcg32(1);
  looks_.clear();
  is_history_whole_ = true;
  has_candidates_ = false;
  draws_ = 0;
  std::fill_n(bearings_.log_weights.begin(), cell_count(model), std::int16_t{0});
  bearings_.scale = 0;
  std::uint8_t likeliest = 0;
  for (std::uint8_t k = 0; k < tables.tables.size(); ++k)
    likeliest = tables.tables[k].prior > tables.tables[likeliest].prior ? k : likeliest;
  // The likeliest ocean in every way that is not rare, and as many others as there is room for.
  std::array<Hypothesis, kLanes> hypotheses;
  hypotheses.fill({.table = likeliest});
  hypotheses[1].spread = 1;
  hypotheses[2].spread = 0;
  hypotheses[3].level = 1;
  hypotheses[4].level = 5;
  hypotheses[5].silence = 1;
  hypotheses[6].mobility = 1;
  hypotheses[7].spread = 3;
  for (HypothesisBlock& block : residents_) block.start(model, hypotheses, bearings_);
  std::size_t next = 0;
  for (std::size_t b = 1; b < residents_.size(); ++b) {
    for (Hypothesis& h : hypotheses) {
      do h = at_start(tables, next++);
      while (residents_[0].holds(h));  // one that is held twice would count twice
    }
    residents_[b].start(model, hypotheses, bearings_);
  }
  std::fill_n(marginal_.begin(), cell_count(model), 1.0F / static_cast<float>(cell_count(model)));
  find_posteriors(model, tables);
  find_shares();
  summary_ = {};
  outlooks_ = {};
}

void OceanBelief::update(const BeliefModel& model, const OceanTables& tables, NorthEast position, Reception reception) {
  const Look look{position, reception.snr, reception.too_faint};
  is_history_whole_ = looks_.push_back(look) == Status::kOk && is_history_whole_;
  find_ranges(model, position, tables.range_step, tables.range_count - std::size_t{1}, ranges_);
  if (reception.bearing) take_in_bearing(model, position, *reception.bearing);
  for (HypothesisBlock& block : residents_) take_in(model, tables, look, block);
  find_posteriors(model, tables);
  find_shares();
  if (is_history_whole_) weigh_others(model, tables);
  find_marginal(model);
  foresee(model, tables);
  const std::span<const float> probabilities = std::span(marginal_).first(cell_count(model));
  summary_ = summary_of(model, probabilities);
  const std::size_t ranges = tables.range_count;
  find_outlooks(model, probabilities, {std::span(search_cost_).first(ranges), std::span(detected_).first(ranges), tables.range_step},
                position, std::span(outlooks_).first(model.actions.size()));
}

/// The others that are being weighed hear it now, whatever they have heard of the past: where a source rests the order is the same to them.
void OceanBelief::take_in_bearing(const BeliefModel& model, NorthEast position, const messages::Bearing& bearing) {
  const BearingLikelihood likelihood(bearing, Meters{std::max(cell_north(model), cell_east(model))}, model.outlier_share);
  for (std::size_t i = 0; i < cell_count(model); ++i)
    bearing_[i] = static_cast<std::int16_t>(std::max<int>(to_log(likelihood.at(way_to_cell(model, position, i))), kForgotten));
  const std::span<std::int16_t> said = std::span(bearing_).first(cell_count(model));
  const std::span<std::int16_t> sum = std::span(bearings_.log_weights).first(cell_count(model));
  take_off_highest(said);
  std::transform(sum.begin(), sum.end(), said.begin(), sum.begin(),
                 [](std::int16_t before, std::int16_t now) { return static_cast<std::int16_t>(before + now); });
  bearings_.scale += take_off_highest(sum);
  for (HypothesisBlock& block : residents_) block.weigh_places(model, bearing_);
  if (has_candidates_) candidates_.weigh_places(model, bearing_);
}

/// The ranges are those from the look's position.
void OceanBelief::take_in(const BeliefModel& model, const OceanTables& tables, const Look& look, HypothesisBlock& block) {
  block.let_move(model);
  likelihoods_.tabulate(model, tables, block.hypotheses(), {.snr = look.snr, .too_faint = look.too_faint});
  block.weigh(model, likelihoods_.by_range(tables), ranges_);
}

void OceanBelief::find_posteriors(const BeliefModel& model, const OceanTables& tables) {
  for (std::size_t b = 0; b < residents_.size(); ++b) {
    posteriors_[b] = residents_[b].log_evidence(model);
    for (std::size_t l = 0; l < kLanes; ++l) posteriors_[b][l] += log_prior(residents_[b].hypothesis(l), tables);
  }
}

void OceanBelief::find_shares() {
  int highest = kNoPosterior;
  for (const Posteriors& posteriors : posteriors_) {
    for (const int posterior : posteriors) highest = std::max(highest, posterior);
  }
  float sum = 0.0F;
  for (std::size_t b = 0; b < residents_.size(); ++b) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      shares_[b][l] = from_log(std::max(posteriors_[b][l] - highest, -kMostBelow));
      sum += shares_[b][l];
    }
  }
  for (FloatLanes& shares : shares_) {
    for (float& share : shares) share /= sum;
  }
}

void OceanBelief::weigh_others(const BeliefModel& model, const OceanTables& tables) {
  for (std::size_t budget = kLooksOfOthers; budget > 0;) {
    if (!has_candidates_) draw_candidates(model, tables);
    for (; budget > 0 && candidates_heard_ < looks_.size(); --budget) {
      const Look& look = looks_[candidates_heard_++];
      find_ranges(model, look.position, tables.range_step, tables.range_count - std::size_t{1}, ranges_);
      take_in(model, tables, look, candidates_);
    }
    if (candidates_heard_ < looks_.size()) return;  // the next look goes on
    take_the_likelier(model, tables);
    has_candidates_ = false;
  }
}

void OceanBelief::draw_candidates(const BeliefModel& model, const OceanTables& tables) {
  std::array<Hypothesis, kLanes> hypotheses;
  const Motion motion = draws_ % kDrawsPerMoving == kDrawsPerMoving - 1 ? Motion::kMoving : Motion::kAtRest;
  ++draws_;
  for (Hypothesis& h : hypotheses) h = draw_candidate(tables, motion);
  candidates_.start(model, hypotheses, bearings_);
  candidates_heard_ = 0;
  has_candidates_ = true;
}

bool OceanBelief::is_held(const Hypothesis& hypothesis) const {
  return std::any_of(residents_.begin(), residents_.end(), [&](const HypothesisBlock& block) { return block.holds(hypothesis); });
}

/// One that is not held: half of the times from the prior, else like one that is held and likely.
Hypothesis OceanBelief::draw_candidate(const OceanTables& tables, Motion motion) {
  Hypothesis h;
  for (int draw = 0; draw < kDraws; ++draw) {
    if (random_.uniform_float() < 0.5F) {
      h = draw_hypothesis(tables, motion, random_);
    } else {
      // The parent by the root of its share: one that is nearly certain is not the only one to go on from.
      std::array<float, kHypotheses> weights;
      float sum = 0.0F;
      for (std::size_t i = 0; i < kHypotheses; ++i) sum += weights[i] = __builtin_sqrtf(share(i));
      float left = random_.uniform_float() * sum;
      std::size_t parent = 0;
      while (parent + 1 < kHypotheses && (left -= weights[parent]) >= 0.0F) ++parent;
      h = draw_neighbour(hypothesis(parent), tables, motion, random_);
    }
    if (!is_held(h)) break;
  }
  return h;
}

void OceanBelief::take_the_likelier(const BeliefModel& model, const OceanTables& tables) {
  const std::array<int, kLanes> evidence = candidates_.log_evidence(model);
  for (std::size_t c = 0; c < kLanes; ++c) {
    if (is_held(candidates_.hypothesis(c))) continue;
    const int posterior = evidence[c] + log_prior(candidates_.hypothesis(c), tables);
    std::size_t worst = 0;
    const auto posterior_of = [this](std::size_t i) -> int& { return posteriors_[i / kLanes][i % kLanes]; };
    for (std::size_t i = 1; i < kHypotheses; ++i) worst = posterior_of(i) < posterior_of(worst) ? i : worst;
    if (posterior <= posterior_of(worst)) continue;
    residents_[worst / kLanes].take_over(model, worst % kLanes, candidates_, c);
    posterior_of(worst) = posterior;
  }
  find_shares();
}

void OceanBelief::find_marginal(const BeliefModel& model) {
  const std::span<float> marginal = std::span(marginal_).first(cell_count(model));
  std::fill(marginal.begin(), marginal.end(), 0.0F);
  for (std::size_t b = 0; b < residents_.size(); ++b) {
    if (*std::max_element(shares_[b].begin(), shares_[b].end()) >= kLeastShare) residents_[b].add_to(model, shares_[b], marginal);
  }
}

/// Tabulates by range what a search that goes straight to a source costs, under the hypotheses as likely as they now are.
EARSHOT_WIDE void OceanBelief::foresee(const BeliefModel& model, const OceanTables& tables) {
  const std::size_t count = tables.range_count;
  std::array<float, config::kMaxTableRanges> over_all{};
  std::array<float, config::kMaxTableRanges> detected;  // under one hypothesis
  for (std::size_t i = 0; i < kHypotheses; ++i) {
    if (share(i) < kLeastShare) continue;
    const Hypothesis& h = hypothesis(i);
    const OceanTable& table = tables.tables[h.table];
    const float per_spread = 1.0F / kSpreads_db[h.spread];
    const float level = kLevelOffsets_db[h.level] - static_cast<float>(model.detection_threshold.value);
    const float sounding = (1.0F - kSilenceShares[h.silence]) * share(i);
    for (std::size_t r = 0; r < count; ++r) detected[r] = (table.snr_db(r) + level) * per_spread;
    to_normal_cumulative(std::span(detected).first(count));
    for (std::size_t r = 0; r < count; ++r) over_all[r] += sounding * detected[r];
  }
  smooth(std::span(over_all).first(count), half_cell(model, tables.range_step, count), std::span(detected_).first(count));
  find_search_cost(model, tables.range_step, exp(model.costs.log_step_discount), std::span(detected_).first(count),
                   std::span(search_cost_).first(count));
}

std::uint32_t OceanBelief::fingerprint(const BeliefModel& model) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  std::uint32_t crc = crc32(bytes_of(marginal_.data(), cell_count(model)));
  for (const HypothesisBlock& block : residents_) crc = block.fingerprint(model, crc);
  return crc32(bytes_of(outlooks_.data(), model.actions.size()), crc);
}

}  // namespace earshot::policy
