#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "firmware/core/crc32.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_word.hpp"

namespace earshot::policy {
namespace {

/// A penalty with which even the likeliest is forgotten: of a neighbour from which nothing comes.
constexpr std::int16_t kNever = 1 - kForgotten;

/// What minus_saturated() is to take off the weights of a word: their highest, and so much more that what is forgotten ends at the least
/// that sixteen bits hold. They are "lowered" then: max(weight - highest, kForgotten) + kLeastLogLikelihood.
/// @param highest  at least kLeastLogLikelihood: no measurement is less likely, where the source is the likeliest to be
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
/// @param cell  one word of the first   @param penalty  at least 0
void spread_along(LogWord* cell, std::size_t count, std::size_t apart, const LogWord& penalty) {
  LogWord before = *cell;
  LogWord here = before;
#pragma GCC unroll 3
  for (std::size_t i = 0; i + 1 < count; ++i) {
    LogWord* const next_cell = cell + apart * kWords;
    const LogWord next = *next_cell;
    *cell = max(here, minus_saturated(max(before, next), penalty));
    before = here;
    here = next;
    cell = next_cell;
  }
  *cell = max(here, minus_saturated(max(before, here), penalty));
}

/// Weighs some words of every cell. By itself, or the compiler takes the pointers to pieces for which there are too few registers.
/// @param cell     the words of the first cell
/// @param raised   those of a measurement at the first range, raised as HypothesisBlock::weigh() takes them
/// @param taken    every bit of the hypotheses that are to be weighed
/// @param highest  the highest weights before, then the highest of the weights as they are
[[gnu::noinline]] EARSHOT_WIDE void weigh_words(LogWord* cell, const LogWord* raised, std::span<const std::uint16_t> ranges,
                                                const LogWord* taken, LogWord* highest) {
  LogWords is_taken;
  LogWords off;
  LogWords most;
  for_each_word<kWordsTogether>([&](std::size_t w) {
    is_taken[w] = taken[w];
    off[w] = to_take_off(highest[w]) & is_taken[w];
    most[w] = every_lane(std::numeric_limits<std::int16_t>::min());
  });
  for (const std::uint16_t range : ranges) {
    const LogWord* const raised_here = raised + range * kWords;
    for_each_word<kWordsTogether>([&](std::size_t w) {
      const LogWord weight = minus_saturated(cell[w], off[w]) + (raised_here[w] & is_taken[w]);
      cell[w] = weight;
      most[w] = max(most[w], weight);
    });
    cell += kWords;
  }
  for_each_word<kWordsTogether>([&](std::size_t w) { highest[w] = most[w]; });
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
  has_sums_ = false;
}

EARSHOT_WIDE void HypothesisBlock::spread_word(const BeliefModel& model, std::size_t word, const LogLanes& penalties) {
  const LogWord penalty = words_of(penalties)[word];
  const std::size_t rows = model.cells_north;
  const std::size_t columns = model.cells_east;
  for (std::size_t n = 0; n < rows; ++n) spread_along(words_of(weights_[n * columns]) + word, columns, 1, penalty);
  for (std::size_t e = 0; e < columns; ++e) spread_along(words_of(weights_[e]) + word, rows, columns, penalty);
}

template <std::size_t kCount>
void HypothesisBlock::sum_words(const BeliefModel& model, std::size_t first) const {
  const std::size_t cells = cell_count(model);
  std::array<LogWord, kCount> off;
  for_each_word<kCount>([&](std::size_t w) { off[w] = to_take_off(words_of(highest_)[first + w]); });
  std::array<FloatWord, kCount> sums{};
  const LogWord* cell = words_of(weights_[0]) + first;
#pragma GCC unroll 2
  for (std::size_t i = 0; i < cells; ++i, cell += kWords) {
    for_each_word<kCount>([&](std::size_t w) {
      FloatWord p;
      from_log(minus_saturated(cell[w], off[w]), p);
      sums[w] += p;
    });
  }
  for_each_word<kCount>([&](std::size_t w) {
    for (std::size_t l = 0; l < kLanesInAWord; ++l) sums_[(first + w) * kLanesInAWord + l] = lane_of(sums[w], l) * kPerLowered;
  });
}

EARSHOT_WIDE void HypothesisBlock::let_move(const BeliefModel& model) {
  std::uint8_t most = 0;
  for (const Hypothesis& h : hypotheses_) most = std::max(most, kMobilities[h.mobility].cells);
  if (most == 0) return;
  const FloatLanes before = sums(model);
  for (std::size_t word = 0; word < kWords; ++word) {
    bool has_moved = false;
    for (std::uint8_t cells = 0; cells < most; ++cells) {
      const auto moves = [&](std::size_t l) { return cells < kMobilities[hypotheses_[l].mobility].cells; };
      if (!any_of_word(word, moves)) break;
      LogLanes penalties;
      for (std::size_t l = 0; l < kLanes; ++l) penalties[l] = moves(l) ? kMobilities[hypotheses_[l].mobility].penalty : kNever;
      spread_word(model, word, penalties);
      has_moved = true;
    }
    if (has_moved) sum_words<1>(model, word);
  }
  // Nothing has been heard: they are as likely as before.
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] -= to_log(sums_[l]) - to_log(before[l]);
}

void HypothesisBlock::weigh(const BeliefModel& model, const Lanes& lanes, std::span<const LogLanes> raised_log_likelihoods,
                            std::span<const std::uint16_t> ranges) {
  take_off_highest(lanes);
  const LogLanes taken = bits_of(lanes);
  for (std::size_t first = 0; first < kWords; first += kWordsTogether) {
    bool any = false;
    for (std::size_t w = first; w < first + kWordsTogether; ++w) any = any || any_of_word(w, lanes);
    if (!any) continue;
    weigh_words(words_of(weights_[0]) + first, words_of(raised_log_likelihoods[0]) + first, ranges.first(cell_count(model)),
                words_of(taken) + first, words_of(highest_) + first);
  }
}

void HypothesisBlock::weigh_places(const BeliefModel& model, const Lanes& lanes, std::span<const std::int16_t> log_likelihoods) {
  take_off_highest(lanes);
  const LogLanes each_taken = bits_of(lanes);
  const std::size_t cells = cell_count(model);
  for (std::size_t word = 0; word < kWords; ++word) {
    if (!any_of_word(word, lanes)) continue;
    const LogWord taken = words_of(each_taken)[word];
    const LogWord off = to_take_off(words_of(highest_)[word]) & taken;
    LogWord highest = every_lane(std::numeric_limits<std::int16_t>::min());
    LogWord* cell = words_of(weights_[0]) + word;
    for (const std::int16_t log_likelihood : log_likelihoods.first(cells)) {
      const auto raised = static_cast<std::int16_t>(log_likelihood - kLeastLogLikelihood);
      *cell = minus_saturated(*cell, off) + (every_lane(raised) & taken);
      highest = max(highest, *cell);
      cell += kWords;
    }
    words_of(highest_)[word] = highest;
  }
}

/// What is to be weighed is less likely by the highest weight, which is lost from the weights.
void HypothesisBlock::take_off_highest(const Lanes& lanes) {
  has_sums_ = false;
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] += lanes[l] ? highest_[l] : 0;
}

EARSHOT_WIDE const FloatLanes& HypothesisBlock::sums(const BeliefModel& model) const {
  if (has_sums_) return sums_;
  for (std::size_t first = 0; first < kWords; first += kWordsTogether) sum_words<kWordsTogether>(model, first);
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

EARSHOT_WIDE void HypothesisBlock::add_to(const BeliefModel& model, const FloatLanes& shares, const CellWindow& window, bool is_first,
                                          std::span<float> marginal) const {
  const FloatLanes& per_weight = sums(model);
  FloatLanes each_scale;
  for (std::size_t l = 0; l < kLanes; ++l) each_scale[l] = shares[l] / per_weight[l] * kPerLowered;
  std::array<FloatWord, kWords> scales;
  std::array<LogWord, kWords> off;
  for_each_word([&](std::size_t word) {
    get(each_scale, word, scales[word]);
    off[word] = to_take_off(words_of(highest_)[word]);
  });
  const auto probability_of = [&](const LogWord* cell) {
    std::array<FloatWord, kWords> p;
    for_each_word([&](std::size_t word) {
      from_log(minus_saturated(cell[word], off[word]), p[word]);
      p[word] *= scales[word];
    });
    const auto of = [&p](std::size_t lane) { return lane_of(p[lane / kLanesInAWord], lane % kLanesInAWord); };
    return ((of(0) + of(1)) + (of(2) + of(3))) + ((of(4) + of(5)) + (of(6) + of(7)));
  };
  const std::size_t columns = model.cells_east;
  for (std::size_t n = window.north.first; n < window.north.end; ++n) {
    const std::size_t first = n * columns + window.east.first;
    const LogWord* cell = words_of(weights_[0]) + first * kWords;  // behind the last where the window is empty
    const std::span<float> row = marginal.subspan(first, window.east.end - std::size_t{window.east.first});
    if (is_first) {
      for (std::size_t e = 0; e < row.size(); ++e) row[e] = probability_of(cell + e * kWords);
    } else {
      for (std::size_t e = 0; e < row.size(); ++e) row[e] += probability_of(cell + e * kWords);
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
}

std::uint32_t HypothesisBlock::fingerprint(const BeliefModel& model, std::uint32_t crc) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  return crc32(bytes_of(weights_.data(), cell_count(model)), crc32(bytes_of(scale_.data(), scale_.size()), crc));
}

}  // namespace earshot::policy
