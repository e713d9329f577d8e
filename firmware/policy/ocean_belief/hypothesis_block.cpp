#include "firmware/policy/ocean_belief/hypothesis_block.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "firmware/core/crc32.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_word.hpp"

namespace earshot::policy {
namespace {

/// Below anything that a cell can hold: of a neighbour from which nothing comes.
constexpr std::int16_t kNever = -18'000;
static_assert(kNever < kForgotten && kForgotten + kNever >= std::numeric_limits<std::int16_t>::min());

/// What minus_saturated() is to take off the weights of a word: their highest, and so much more that what is forgotten ends at the least
/// that sixteen bits hold. They are "lowered" then: max(weight - highest, kForgotten) + kLeastLogLikelihood.
/// @param highest  at least kLeastLogLikelihood: no look is less likely, where the source is the likeliest to be
LogWord to_take_off(const LogWord& highest) {
  static_assert(kForgotten + kLeastLogLikelihood == std::numeric_limits<std::int16_t>::min());
  return highest - every_lane(kLeastLogLikelihood);
}
/// A probability is so many times that of the lowered weight: a power of two, which changes its exponent alone.
constexpr auto kPerLowered = static_cast<float>(std::uint64_t{1} << unsigned{-kLeastLogLikelihood / kOctave});
static_assert(kLeastLogLikelihood % kOctave == 0);

/// Of a cell whose probability is worth adding, one by one: a millionth of the likeliest cell's.
constexpr int kLeastAdded = -20 * kOctave;

/// Whether something holds for one lane of a word at least.
template <class Holds>
bool any_of_word(std::size_t word, Holds holds) {
  bool any = false;
  for (std::size_t l = word * kLanesInAWord; l < (word + 1) * kLanesInAWord; ++l) any = any || holds(l);
  return any;
}

/// The same of lanes that are named one by one.
bool any_of_word(std::size_t word, const Lanes& lanes) {
  return any_of_word(word, [&lanes](std::size_t l) { return lanes[l]; });
}

/// Every bit of these lanes.
LogLanes bits_of(const Lanes& lanes) {
  LogLanes bits;
  for (std::size_t l = 0; l < kLanes; ++l) bits[l] = lanes[l] ? -1 : 0;
  return bits;
}

/// Lets every cell be reached from its neighbours along one line of `count` cells, `apart` from one another.
void spread_along(LogLanes* cells, std::size_t count, std::size_t apart, std::size_t word, const LogWord& penalty) {
  LogWord before = word_of(*cells, word);
  LogWord here = before;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    LogLanes* const next_cell = cells + apart;
    const LogWord next = word_of(*next_cell, word);
    put(*cells, word, max(here, max(before, next) + penalty));
    before = here;
    here = next;
    cells = next_cell;
  }
  put(*cells, word, max(here, max(before, here) + penalty));
}

}  // namespace

void HypothesisBlock::start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses, const PlacePrior& prior) {
  start(model, hypotheses);
  for (std::size_t i = 0; i < cell_count(model); ++i) weights_[i] = LogLanes{} + prior.log_weights[i];
  scale_.fill(prior.scale);
}

void HypothesisBlock::start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses) {
  hypotheses_ = hypotheses;
  std::fill_n(weights_.begin(), cell_count(model), LogLanes{});
  highest_ = LogLanes{};
  scale_.fill(0);
  is_settled_.fill(true);
  has_sums_ = false;
}

EARSHOT_WIDE void HypothesisBlock::settle(const BeliefModel& model) {
  const std::size_t cells = cell_count(model);
  const LogWord forgotten = every_lane(kForgotten);
  for (std::size_t word = 0; word < kWords; ++word) {
    if (is_settled_[word]) continue;
    is_settled_[word] = true;
    const LogWord highest = word_of(highest_, word);
    for (std::size_t i = 0; i < cells; ++i) put(weights_[i], word, max(word_of(weights_[i], word) - highest, forgotten));
  }
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] += highest_[l];
  highest_ = LogLanes{};
}

EARSHOT_WIDE void HypothesisBlock::spread_word(const BeliefModel& model, std::size_t word, const LogLanes& penalties) {
  const LogWord penalty = word_of(penalties, word);
  const std::size_t rows = model.cells_north;
  const std::size_t columns = model.cells_east;
  for (std::size_t n = 0; n < rows; ++n) spread_along(&weights_[n * columns], columns, 1, word, penalty);
  for (std::size_t e = 0; e < columns; ++e) spread_along(&weights_[e], rows, columns, word, penalty);
}

void HypothesisBlock::let_move(const BeliefModel& model) {
  std::uint8_t most = 0;
  for (const Hypothesis& h : hypotheses_) most = std::max(most, kMobilities[h.mobility].cells);
  if (most == 0) return;
  settle(model);
  const FloatLanes before = sums(model);
  for (std::size_t word = 0; word < kWords; ++word) {
    bool has_moved = false;
    for (std::uint8_t cells = 0; cells < most; ++cells) {
      const auto moves = [&](std::size_t l) { return cells < kMobilities[hypotheses_[l].mobility].cells; };
      if (!any_of_word(word, moves)) break;
      LogLanes penalties;
      for (std::size_t l = 0; l < kLanes; ++l)
        penalties[l] = moves(l) ? static_cast<std::int16_t>(-kMobilities[hypotheses_[l].mobility].penalty) : kNever;
      spread_word(model, word, penalties);
      has_moved = true;
    }
    if (has_moved) sum_word(model, word);
  }
  // Nothing has been heard: they are as likely as before.
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] -= to_log(sums_[l]) - to_log(before[l]);
}

EARSHOT_WIDE void HypothesisBlock::weigh_word(const BeliefModel& model, std::size_t word, const Lanes& lanes,
                                              std::span<const LogLanes> raised_log_likelihoods, std::span<const std::uint16_t> ranges) {
  const std::size_t cells = cell_count(model);
  const LogWord taken = word_of(bits_of(lanes), word);
  const LogWord off = to_take_off(word_of(highest_, word)) & taken;
  LogWord highest = every_lane(std::numeric_limits<std::int16_t>::min());
#pragma GCC unroll 4
  for (std::size_t i = 0; i < cells; ++i) {
    const LogWord weight = minus_saturated(word_of(weights_[i], word), off) + (word_of(raised_log_likelihoods[ranges[i]], word) & taken);
    put(weights_[i], word, weight);
    highest = max(highest, weight);
  }
  put(highest_, word, highest);
  is_settled_[word] = false;
}

void HypothesisBlock::weigh(const BeliefModel& model, const Lanes& lanes, std::span<const LogLanes> raised_log_likelihoods,
                            std::span<const std::uint16_t> ranges) {
  has_sums_ = false;
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] += lanes[l] ? highest_[l] : 0;
  for (std::size_t word = 0; word < kWords; ++word) {
    if (any_of_word(word, lanes)) weigh_word(model, word, lanes, raised_log_likelihoods, ranges);
  }
}

void HypothesisBlock::weigh_places(const BeliefModel& model, const Lanes& lanes, std::span<const std::int16_t> log_likelihoods) {
  settle(model);
  has_sums_ = false;
  const LogLanes each_taken = bits_of(lanes);
  const std::size_t cells = cell_count(model);
  for (std::size_t word = 0; word < kWords; ++word) {
    if (!any_of_word(word, lanes)) continue;
    const LogWord taken = word_of(each_taken, word);
    LogWord highest = every_lane(std::numeric_limits<std::int16_t>::min());
    for (std::size_t i = 0; i < cells; ++i) {
      const LogWord weight = word_of(weights_[i], word) + (every_lane(log_likelihoods[i]) & taken);
      put(weights_[i], word, weight);
      highest = max(highest, weight);
    }
    put(highest_, word, highest);
    is_settled_[word] = false;
  }
}

EARSHOT_WIDE void HypothesisBlock::sum_word(const BeliefModel& model, std::size_t word) const {
  const std::size_t cells = cell_count(model);
  const LogWord off = to_take_off(word_of(highest_, word));
  FloatWord sum{};
#pragma GCC unroll 4
  for (std::size_t i = 0; i < cells; ++i) {
    FloatWord p;
    from_log(minus_saturated(word_of(weights_[i], word), off), p);
    sum += p;
  }
  for (std::size_t l = 0; l < kLanesInAWord; ++l) sums_[word * kLanesInAWord + l] = lane_of(sum, l) * kPerLowered;
}

const FloatLanes& HypothesisBlock::sums(const BeliefModel& model) const {
  if (has_sums_) return sums_;
  for (std::size_t word = 0; word < kWords; ++word) sum_word(model, word);
  has_sums_ = true;
  return sums_;
}

bool HypothesisBlock::holds(const Hypothesis& hypothesis) const {
  return std::ranges::find(hypotheses_, hypothesis) != hypotheses_.end();
}

std::array<int, kLanes> HypothesisBlock::log_evidence(const BeliefModel& model) const {
  const FloatLanes sums_of_cells = sums(model);
  std::array<int, kLanes> evidence;
  for (std::size_t l = 0; l < kLanes; ++l) evidence[l] = scale_[l] + highest_[l] + to_log(sums_of_cells[l]);
  return evidence;
}

EARSHOT_WIDE void HypothesisBlock::add_to(const BeliefModel& model, const FloatLanes& shares, const CellWindow& window,
                                          std::span<float> marginal) const {
  const FloatLanes& per_weight = sums(model);
  FloatLanes each_scale;
  for (std::size_t l = 0; l < kLanes; ++l) each_scale[l] = shares[l] / per_weight[l] * kPerLowered;
  std::array<FloatWord, kWords> scales;
  std::array<LogWord, kWords> off;
  for_each_word([&](std::size_t word) {
    get(each_scale, word, scales[word]);
    off[word] = to_take_off(word_of(highest_, word));
  });
  const std::size_t columns = model.cells_east;
  for (std::size_t n = window.north.first; n < window.north.end; ++n) {
    for (std::size_t i = n * columns + window.east.first; i < n * columns + window.east.end; ++i) {
      std::array<FloatWord, kWords> p;
      for_each_word([&](std::size_t word) {
        from_log(minus_saturated(word_of(weights_[i], word), off[word]), p[word]);
        p[word] *= scales[word];
      });
      const auto of = [&p](std::size_t lane) { return lane_of(p[lane / kLanesInAWord], lane % kLanesInAWord); };
      marginal[i] += ((of(0) + of(1)) + (of(2) + of(3))) + ((of(4) + of(5)) + (of(6) + of(7)));
    }
  }
}

void HypothesisBlock::add_to(const BeliefModel& model, std::size_t lane, float share, std::span<const std::uint16_t> axes,
                             const CellWindow& window, std::span<float> marginal) const {
  const float scale = share / sums(model)[lane];
  const int highest = highest_[lane];
  const std::size_t columns = model.cells_east;
  const std::span<const std::uint16_t> column_of = axes.subspan(model.cells_north);
  const std::size_t width = window.east.end - std::size_t{window.east.first};
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    if (axes[n] < window.north.first * columns || axes[n] >= window.north.end * columns) continue;
    const LogLanes* const weights = &weights_[n * columns];
    float* const row = &marginal[axes[n]];
    for (std::size_t e = 0; e < columns; ++e) {
      const int weight = weights[e][lane] - highest;
      if (weight < kLeastAdded) continue;
      if (column_of[e] - std::size_t{window.east.first} < width) row[column_of[e]] += scale * from_log(weight);
    }
  }
}

void HypothesisBlock::take_over(const BeliefModel& model, std::size_t lane, const HypothesisBlock& from, std::size_t from_lane) {
  static_cast<void>(sums(model));
  sums_[lane] = from.sums(model)[from_lane];
  hypotheses_[lane] = from.hypotheses_[from_lane];
  for (std::size_t i = 0; i < cell_count(model); ++i) weights_[i][lane] = from.weights_[i][from_lane];
  highest_[lane] = from.highest_[from_lane];
  scale_[lane] = from.scale_[from_lane];
  is_settled_[lane / kLanesInAWord] = false;
}

std::uint32_t HypothesisBlock::fingerprint(const BeliefModel& model, std::uint32_t crc) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  return crc32(bytes_of(weights_.data(), cell_count(model)), crc32(bytes_of(scale_.data(), scale_.size()), crc));
}

}  // namespace earshot::policy
