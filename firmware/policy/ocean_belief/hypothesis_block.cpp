#include "firmware/policy/ocean_belief/hypothesis_block.hpp"

#include <algorithm>
#include <bit>

#include "firmware/core/crc32.hpp"
#include "firmware/core/wide.hpp"

namespace earshot::policy {
namespace {

/// Below anything that a cell can hold: of a neighbour from which nothing comes.
constexpr std::int16_t kNever = -18'000;
/// No weight is below it.
constexpr std::int16_t kLowest = -32'768;
static_assert(kNever < kForgotten && kForgotten + kNever >= -32'768);

/// Of a cell whose probability is worth adding, one by one: a millionth of the likeliest cell's.
constexpr int kLeastAdded = -20 * kOctave;

using IntLanes = std::int32_t __attribute__((vector_size(4 * kLanes)));
using VectorLanes = float __attribute__((vector_size(4 * kLanes)));

LogLanes all(std::int16_t value) {
  return LogLanes{} + value;
}

LogLanes every_bit_of(const Lanes& lanes) {
  LogLanes bits;
  for (std::size_t l = 0; l < kLanes; ++l) bits[l] = lanes[l] ? -1 : 0;
  return bits;
}

LogLanes max(const LogLanes& a, const LogLanes& b) {
  return a > b ? a : b;
}

/// from_log() of every lane.
void from_log(const LogLanes& weight, VectorLanes& probability) {
  const IntLanes w = __builtin_convertvector(weight, IntLanes);
  const VectorLanes f = __builtin_convertvector(w & (kOctave - 1), VectorLanes) * (1.0F / static_cast<float>(kOctave));
  const VectorLanes mantissa = kPowerOfTwo[0] + f * (kPowerOfTwo[1] + f * (kPowerOfTwo[2] + f * kPowerOfTwo[3]));
  probability = reinterpret_cast<VectorLanes>(reinterpret_cast<IntLanes>(mantissa) + (w >> 9) * (1 << 23));
}

std::int16_t max(std::int16_t a, std::int16_t b) {
  return std::max(a, b);
}

/// Lets every cell be reached from its neighbours along one line of `count` cells, `apart` from one another.
/// @param cell_at  the weight of a cell, or its weights, to be written
template <class Weight, class CellAt>
void spread_along(std::size_t first, std::size_t count, std::size_t apart, const Weight& penalty, CellAt cell_at) {
  Weight before = cell_at(first);
  for (std::size_t i = 0; i < count; ++i) {
    auto&& cell = cell_at(first + i * apart);
    const Weight here = cell;
    const Weight next = cell_at(first + std::min(i + 1, count - 1) * apart);
    cell = max(here, static_cast<Weight>(max(before, next) + penalty));
    before = here;
  }
}

/// The same for the rows and the columns of the grid.
template <class Weight, class CellAt>
void spread(const BeliefModel& model, const Weight& penalty, CellAt cell_at) {
  for (std::size_t n = 0; n < model.cells_north; ++n) spread_along(n * model.cells_east, model.cells_east, 1, penalty, cell_at);
  for (std::size_t e = 0; e < model.cells_east; ++e) spread_along(e, model.cells_north, model.cells_east, penalty, cell_at);
}

}  // namespace

void HypothesisBlock::start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses, const PlacePrior& prior) {
  start(model, hypotheses);
  for (std::size_t i = 0; i < cell_count(model); ++i) weights_[i] = all(prior.log_weights[i]);
  scale_.fill(prior.scale);
}

void HypothesisBlock::start(const BeliefModel& model, const std::array<Hypothesis, kLanes>& hypotheses) {
  hypotheses_ = hypotheses;
  std::fill_n(weights_.begin(), cell_count(model), all(0));
  highest_ = all(0);
  scale_.fill(0);
  has_sums_ = false;
}

EARSHOT_WIDE void HypothesisBlock::settle_together(const BeliefModel& model) {
  const LogLanes highest = highest_;
  const LogLanes forgotten = all(kForgotten);
  for (std::size_t i = 0; i < cell_count(model); ++i) weights_[i] = max(weights_[i] - highest, forgotten);
}

void HypothesisBlock::settle_one(const BeliefModel& model, std::size_t lane) {
  const int highest = highest_[lane];
  for (std::size_t i = 0; i < cell_count(model); ++i)
    weights_[i][lane] = static_cast<std::int16_t>(std::max(weights_[i][lane] - highest, int{kForgotten}));
}

void HypothesisBlock::settle(const BeliefModel& model) {
  if constexpr (kHasVectors) {
    settle_together(model);
  } else {
    for (std::size_t l = 0; l < kLanes; ++l) settle_one(model, l);
  }
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] += highest_[l];
  highest_ = all(0);
}

EARSHOT_WIDE void HypothesisBlock::spread_together(const BeliefModel& model, std::uint8_t cells) {
  LogLanes penalty;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Mobility& mobility = kMobilities[hypotheses_[l].mobility];
    penalty[l] = cells < mobility.cells ? static_cast<std::int16_t>(-mobility.penalty) : kNever;
  }
  spread(model, penalty, [this](std::size_t i) -> LogLanes& { return weights_[i]; });
}

void HypothesisBlock::spread_one(const BeliefModel& model, std::size_t lane) {
  const auto penalty = static_cast<std::int16_t>(-kMobilities[hypotheses_[lane].mobility].penalty);
  spread(model, penalty, [this, lane](std::size_t i) -> std::int16_t& { return reinterpret_cast<std::int16_t*>(&weights_[i])[lane]; });
}

void HypothesisBlock::let_move(const BeliefModel& model) {
  std::uint8_t most = 0;
  for (const Hypothesis& h : hypotheses_) most = std::max(most, kMobilities[h.mobility].cells);
  if (most == 0) return;
  settle(model);
  const FloatLanes before = sums(model);
  has_sums_ = false;
  for (std::uint8_t cells = 0; cells < most; ++cells) {
    if constexpr (kHasVectors) {
      spread_together(model, cells);
    } else {
      for (std::size_t l = 0; l < kLanes; ++l) {
        if (cells < kMobilities[hypotheses_[l].mobility].cells) spread_one(model, l);
      }
    }
  }
  const FloatLanes after = sums(model);  // nothing has been heard: they are as likely as before
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] -= to_log(after[l]) - to_log(before[l]);
}

EARSHOT_WIDE void HypothesisBlock::weigh_together(const BeliefModel& model, const Lanes& lanes, std::span<const LogLanes> log_likelihoods,
                                                  std::span<const std::uint16_t> ranges) {
  const std::size_t cells = cell_count(model);
  const LogLanes taken = every_bit_of(lanes);
  const LogLanes before = highest_ & taken;
  const LogLanes least = (all(kForgotten) & taken) | (all(kLowest) & ~taken);
  LogLanes highest = all(kLowest);
  for (std::size_t i = 0; i < cells; ++i) {
    const LogLanes weight = max(weights_[i] - before, least) + (log_likelihoods[ranges[i]] & taken);
    weights_[i] = weight;
    highest = max(highest, weight);
  }
  for (std::size_t l = 0; l < kLanes; ++l) scale_[l] += before[l];
  highest_ = highest;
}

void HypothesisBlock::weigh_one(const BeliefModel& model, std::size_t lane, std::span<const LogLanes> log_likelihoods,
                                std::span<const std::uint16_t> ranges) {
  const std::size_t cells = cell_count(model);
  const int before = highest_[lane];
  int highest = kLowest;
  for (std::size_t i = 0; i < cells; ++i) {
    const int weight = std::max(weights_[i][lane] - before, int{kForgotten}) + log_likelihoods[ranges[i]][lane];
    weights_[i][lane] = static_cast<std::int16_t>(weight);
    highest = std::max(highest, weight);
  }
  scale_[lane] += before;
  highest_[lane] = static_cast<std::int16_t>(highest);
}

void HypothesisBlock::weigh(const BeliefModel& model, const Lanes& lanes, std::span<const LogLanes> log_likelihoods,
                            std::span<const std::uint16_t> ranges) {
  has_sums_ = false;
  if constexpr (kHasVectors) {
    weigh_together(model, lanes, log_likelihoods, ranges);
  } else {
    for (std::size_t l = 0; l < kLanes; ++l) {
      if (lanes[l]) weigh_one(model, l, log_likelihoods, ranges);
    }
  }
}

void HypothesisBlock::weigh_places(const BeliefModel& model, const Lanes& lanes, std::span<const std::int16_t> log_likelihoods) {
  settle(model);
  has_sums_ = false;
  const LogLanes taken = every_bit_of(lanes);
  LogLanes highest = all(kLowest);
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    weights_[i] += all(log_likelihoods[i]) & taken;
    highest = max(highest, weights_[i]);
  }
  highest_ = highest;
}

EARSHOT_WIDE FloatLanes HypothesisBlock::sum_together(const BeliefModel& model) const {
  const LogLanes highest = highest_;
  const LogLanes forgotten = all(kForgotten);
  VectorLanes sums{};
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    VectorLanes p;
    from_log(max(weights_[i] - highest, forgotten), p);
    sums += p;
  }
  FloatLanes result;
  for (std::size_t l = 0; l < kLanes; ++l) result[l] = sums[l];
  return result;
}

float HypothesisBlock::sum_one(const BeliefModel& model, std::size_t lane) const {
  const int highest = highest_[lane];
  float sum = 0.0F;
  for (std::size_t i = 0; i < cell_count(model); ++i) sum += policy::from_log(std::max(weights_[i][lane] - highest, int{kForgotten}));
  return sum;
}

const FloatLanes& HypothesisBlock::sums(const BeliefModel& model) const {
  if (has_sums_) return sums_;
  has_sums_ = true;
  if constexpr (kHasVectors) {
    sums_ = sum_together(model);
  } else {
    for (std::size_t l = 0; l < kLanes; ++l) sums_[l] = sum_one(model, l);
  }
  return sums_;
}

bool HypothesisBlock::holds(const Hypothesis& hypothesis) const {
  return std::find(hypotheses_.begin(), hypotheses_.end(), hypothesis) != hypotheses_.end();
}

std::array<int, kLanes> HypothesisBlock::log_evidence(const BeliefModel& model) const {
  const FloatLanes sums_of_cells = sums(model);
  std::array<int, kLanes> evidence;
  for (std::size_t l = 0; l < kLanes; ++l) evidence[l] = scale_[l] + highest_[l] + to_log(sums_of_cells[l]);
  return evidence;
}

EARSHOT_WIDE void HypothesisBlock::add_together(const BeliefModel& model, const FloatLanes& shares, std::span<float> marginal) const {
  const FloatLanes& per_weight = sums(model);
  VectorLanes scale;
  for (std::size_t l = 0; l < kLanes; ++l) scale[l] = shares[l] / per_weight[l];
  const LogLanes highest = highest_;
  const LogLanes forgotten = all(kForgotten);
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    VectorLanes p;
    from_log(max(weights_[i] - highest, forgotten), p);
    p *= scale;
    marginal[i] += ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
  }
}

void HypothesisBlock::add_each(const BeliefModel& model, const FloatLanes& shares, std::span<float> marginal) const {
  const FloatLanes& per_weight = sums(model);
  FloatLanes scale;
  std::array<std::uint8_t, kLanes> likely;
  std::size_t count = 0;
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (shares[l] > 0.0F) likely[count++] = static_cast<std::uint8_t>(l);
    scale[l] = shares[l] / per_weight[l];
  }
  FloatLanes p{};
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t l = likely[k];
      p[l] = scale[l] * policy::from_log(std::max(weights_[i][l] - highest_[l], int{kForgotten}));
    }
    marginal[i] += ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
  }
}

void HypothesisBlock::add_to(const BeliefModel& model, const FloatLanes& shares, std::span<float> marginal) const {
  kHasVectors ? add_together(model, shares, marginal) : add_each(model, shares, marginal);
}

void HypothesisBlock::add_to(const BeliefModel& model, std::size_t lane, float share, std::span<const std::uint16_t> cells,
                             std::span<float> marginal) const {
  const float scale = share / sums(model)[lane];
  const int highest = highest_[lane];
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    const int weight = weights_[i][lane] - highest;
    if (weight >= kLeastAdded) marginal[cells[i]] += scale * from_log(weight);
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
