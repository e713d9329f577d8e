#include "firmware/policy/action_values/action_values.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/action_values/action_value_places.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {
namespace {

using namespace places;

/// Cells on the side of a block: a cost of kilometres needs no finer grid.
constexpr std::size_t kBlock = 2;
/// A block less likely than this changes no decision.
constexpr float kLeastBlockProbability = 2e-4F;
/// Where the source is less likely than this to be near, the find probability is not computed.
constexpr float kLeastNearProbability = 0.01F;

/// A block of cells, whose probability is taken to lie in one point s.
struct Block {
  Point source;       ///< s
  float probability;  ///< b(s)
  Point goal;         ///< c: the place outside the border nearest to s; it and the next are not told of blocks that are outside it
  float extra_way;    ///< l - sqrt(l^2 - |s - c|^2), m: how much nearer to c than a step length the vehicle must come to find s
};

/// Goes through the grid from the south-west along the rows, for blocks that are no less likely than kLeastBlockProbability.
class LikelyBlocks {
 public:
  /// So many are handed out together. A vector unit has the actions side by side; without one, what a few blocks add up to for an action
  /// stays in a register.
  static constexpr std::size_t kTogether = kHasVectors ? 1 : 16;

  LikelyBlocks(const Grid& grid, const BorderFreeArea& inside, float step_length)
      : grid_(grid),
        inside_(inside),
        step_length_(step_length),
        rows_(outside_border(inside.low.north, inside.high.north, grid.size_north, grid.rows)),
        columns_(outside_border(inside.low.east, inside.high.east, grid.size_east, grid.columns)) {}

  /// The next few, all of them outside the border or all not surely; none behind the last.
  std::span<const Block> next() {
    std::size_t count = 0;
    std::size_t column = column_;
    for (; row_ < grid_.rows; row_ += kBlock, column = 0) {
      const bool is_row_outside = rows_.first <= row_ && row_ < rows_.end;
      for (; column < grid_.columns; column += kBlock) {
        Point centre;
        const float probability = sum_up(column, centre);
        if (probability < kLeastBlockProbability) continue;
        const bool is_outside = is_row_outside && columns_.first <= column && column < columns_.end;
        if (count == 0) are_outside_border_ = is_outside;
        if (count == kTogether || is_outside != are_outside_border_) {
          column_ = column;  // the next begin with this one
          return std::span(blocks_).first(count);
        }
        Block& block = blocks_[count++];
        block.source = centre;
        block.probability = probability;
        if (!is_outside) turn_aside(block);
      }
    }
    column_ = 0;
    return std::span(blocks_).first(count);
  }

  /// Whether those that were handed out last are outside the border: the way to each goes straight to its s.
  [[nodiscard]] bool are_outside_border() const { return are_outside_border_; }

 private:
  /// Blocks along one axis whose cells' centres are outside the border. @param low, high  where it is none, m   @param size  of a cell, m
  static CellWindow::Side outside_border(float low, float high, float size, std::size_t count) {
    std::size_t first = 0;
    while (first < count && (static_cast<float>(first) + 0.5F) * size < low) first += kBlock;
    std::size_t end = first;
    while (end < count && (static_cast<float>(end + kBlock) - 0.5F) * size <= high) end += kBlock;
    return {.first = static_cast<std::uint16_t>(first), .end = static_cast<std::uint16_t>(end)};
  }

  /// Those of the cells [row, row + 2) x [column, column + 2) that exist.
  /// @param centre  of their mass; left as it is where they are unlikely   @return their probability
  [[nodiscard]] float sum_up(std::size_t column, Point& centre) const {
    const bool has_north = row_ + 1 < grid_.rows;
    const bool has_east = column + 1 < grid_.columns;
    const float* const south = &grid_.probabilities[row_ * grid_.columns + column];
    const float south_east = has_east ? south[1] : 0.0F;
    const float north_west = has_north ? south[grid_.columns] : 0.0F;
    const float north_east = has_north && has_east ? south[grid_.columns + 1] : 0.0F;
    const float sum = (south[0] + south_east) + (north_west + north_east);
    if (sum < kLeastBlockProbability) return sum;
    centre = {(static_cast<float>(row_) + 0.5F + (north_west + north_east) / sum) * grid_.size_north,
              (static_cast<float>(column) + 0.5F + (south_east + north_east) / sum) * grid_.size_east};
    return sum;
  }

  /// Finds where the way to a block's s ends.
  void turn_aside(Block& block) const {
    block.goal = inside_.nearest(block.source);
    const float off = distance(block.source, block.goal);
    const float to_goal = off < step_length_ ? __builtin_sqrtf(step_length_ * step_length_ - off * off) : 0.0F;
    block.extra_way = step_length_ - to_goal;
  }

  const Grid& grid_;
  const BorderFreeArea& inside_;
  float step_length_;
  CellWindow::Side rows_;  ///< outside the border, with the columns
  CellWindow::Side columns_;
  std::size_t row_ = 0;
  std::size_t column_ = 0;
  bool are_outside_border_ = false;
  std::array<Block, kTogether> blocks_;
};

/// The likely cells near the vehicle, from the south, side by side for a vector unit.
class NearCells {
 public:
  NearCells(const Grid& grid, Point vehicle, float radius) : per_size_(1.0F / std::max(grid.size_north, grid.size_east)) {
    // No more than 1 / least cells can have the least probability of the last attempt: they fit.
    static_assert(kCapacity * kLeastNearCell * 16.0F >= 1.0F);
    for (float least = kLeastNearCell; !gather(grid, vehicle, radius, least) && least < 1.0F; least *= 4.0F) {
    }
  }

  /// P(|s - y| <= l); a cell counts by as much of it as lies within.
  /// @param place        y
  /// @param step_length  l
  [[nodiscard]] float probability_within(Point place, float step_length) const {
    // Rows of cells that are further off than this add nothing, and neither do cells; a vector unit is faster without asking for each.
    const float reach = 1.001F * (step_length + 0.5F / per_size_);
    const float reach_squared = reach * reach;
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < count_; i += kLanes) {
      if (north_[i + kLanes - 1] < place.north - reach) continue;
      if (north_[i] > place.north + reach) break;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float north = north_[i + lane] - place.north;
        const float east = east_[i + lane] - place.east;
        const float range_squared = north * north + east * east;
        if (!kHasVectors && range_squared > reach_squared) continue;
        const float covered = (step_length - __builtin_sqrtf(range_squared)) * per_size_ + 0.5F;
        sums[lane] += probabilities_[i + lane] * lesser(greater(covered, 0.0F), 1.0F);
      }
    }
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  }

  /// Of all these cells together.
  [[nodiscard]] float probability() const { return probability_; }

 private:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kCapacity = 64;
  static constexpr float kLeastNearCell = 1e-3F;

  /// False when more than kCapacity cells have `least` or more.
  bool gather(const Grid& grid, Point vehicle, float radius, float least) {
    count_ = 0;
    probability_ = 0.0F;
    const CellWindow::Side north = cells_along(vehicle.north, radius, grid.size_north, grid.rows);
    const CellWindow::Side east = cells_along(vehicle.east, radius, grid.size_east, grid.columns);
    for (std::size_t n = north.first; n < north.end; ++n) {
      for (std::size_t e = east.first; e < east.end; ++e) {
        const float probability = grid.probabilities[n * grid.columns + e];
        if (probability < least) continue;
        if (count_ == kCapacity) return false;
        north_[count_] = (static_cast<float>(n) + 0.5F) * grid.size_north;
        east_[count_] = (static_cast<float>(e) + 0.5F) * grid.size_east;
        probabilities_[count_] = probability;
        probability_ += probability;
        ++count_;
      }
    }
    for (; count_ % kLanes != 0; ++count_) {
      north_[count_] = north_[count_ - 1];
      east_[count_] = 0.0F;
      probabilities_[count_] = 0.0F;
    }
    return true;
  }

  std::array<float, kCapacity> north_;  ///< none less than the one before
  std::array<float, kCapacity> east_;
  std::array<float, kCapacity> probabilities_;
  std::size_t count_ = 0;
  float probability_ = 0.0F;
  float per_size_;
};

/// Searches the paths of 1 to kFindSteps steps for the best place to find the source at.
class FindProbabilitySearch {
 public:
  FindProbabilitySearch(const BeliefModel& model, const NearCells& near, const BorderFreeArea& inside)
      : model_(model),
        near_(near),
        inside_(inside),
        step_(static_cast<float>(model.step_length.value)),
        border_cost_(model.costs.edge / model.costs.find_probability) {}

  /// Finds each action's find probability: that of the best end of a path from `start` of which it is a step. A path's end does not depend
  /// on the order of its steps: of the paths a, b, c only those with a <= b <= c are searched, the shorter ones first, which often leave
  /// the others nothing to raise.
  /// @param action_values  [actions]: with what is found at the end of one step, and its border
  void search_from(Point start, std::span<ActionValues> action_values) const {
    static_assert(kFindSteps == 3);
    for (ActionValues& values : action_values) {
      const float border_cost = values.border * border_cost_;
      values.find_probability = border_cost >= 1.0F ? 0.0F : greater(values.found - border_cost, 0.0F);
    }
    const std::size_t count = action_values.size();
    for (const bool has_third : {false, true}) {
      const float discount = model_.costs.find_discount * (has_third ? model_.costs.find_discount : 1.0F);
      for (std::size_t a = 0; a < count; ++a) {
        const Point first_end = end_of_step(start, a);
        for (std::size_t b = a; b < count; ++b) {
          const Point second_end = end_of_step(first_end, b);
          for (std::size_t c = b; c < (has_third ? count : b + 1); ++c)
            raise(action_values[a].find_probability, action_values[b].find_probability, action_values[c].find_probability,
                  has_third ? end_of_step(second_end, c) : second_end, discount);
        }
      }
    }
  }

 private:
  [[nodiscard]] Point end_of_step(Point from, std::size_t action) const {
    return {from.north + step_ * static_cast<float>(model_.actions[action].north),
            from.east + step_ * static_cast<float>(model_.actions[action].east)};
  }

  /// Raises the find probabilities a, b, c of a path's actions to g^(n-1) P(|s - y| <= l) - (e / r) B(y).
  void raise(float& a, float& b, float& c, Point end, float discount) const {
    constexpr float kForRounding = 1.0F + 1e-4F;
    const float border_cost = inside_.border_depth(end) * border_cost_;
    if (border_cost >= discount) return;
    if (discount * near_.probability() * kForRounding - border_cost <= lesser(lesser(a, b), c)) return;
    const float here = discount * near_.probability_within(end, step_) - border_cost;
    a = greater(a, here);
    b = greater(b, here);
    c = greater(c, here);
  }

  const BeliefModel& model_;
  const NearCells& near_;
  const BorderFreeArea& inside_;
  float step_;
  float border_cost_;  ///< e / r: of the border at the edge, in units of a find probability of one
};

/// The expectations E[C(way(x_a, s))] and E[D(|s - x_a|)] of every action a, summed up block by block.
class Expectations {
 public:
  Expectations(const BeliefModel& model, const ValuesByRange& by_range, Point vehicle)
      : samples_(by_range.samples.data()),
        last_(static_cast<float>(by_range.samples.size() - 1)),
        per_range_step_(static_cast<float>(1.0 / by_range.range_step.value)),
        action_count_(model.actions.size()) {
    const auto step = static_cast<float>(model.step_length.value);
    for (std::size_t a = 0; a < action_count_; ++a) {
      ends_[a] = {vehicle.north + step * static_cast<float>(model.actions[a].north),
                  vehicle.east + step * static_cast<float>(model.actions[a].east)};
    }
  }

  /// x_a
  [[nodiscard]] Point end(std::size_t action) const { return ends_[action]; }

  void add(std::span<const Block> blocks) {
    add_ways(blocks,
             [](const Block& block, Point end, float range) { return greater(distance(end, block.goal) + block.extra_way, range); });
  }

  void add_outside_border(std::span<const Block> blocks) {
    add_ways(blocks, [](const Block& /*block*/, Point /*end*/, float range) { return range; });
  }

  [[nodiscard]] float search_cost(std::size_t action) const { return probability_ > 0.0F ? search_cost_[action] / probability_ : 0.0F; }
  [[nodiscard]] float detected(std::size_t action) const { return probability_ > 0.0F ? detected_[action] / probability_ : 0.0F; }

 private:
  /// A sample of the tables, and how far beyond it a range lies, in range steps.
  struct Place {
    const RangeSample& sample;
    float beyond;
  };
  [[nodiscard]] Place place_of(float range) const {
    const float held = lesser(range * per_range_step_, last_);
    const int index = static_cast<int>(held);
    return {samples_[index], held - static_cast<float>(index)};
  }

  /// @param way_of  way(x_a, s) to a block from the end of an action at that range
  template <class Way>
  void add_ways(std::span<const Block> blocks, Way way_of) {
    for (std::size_t a = 0; a < action_count_; ++a) {
      float search_cost = search_cost_[a];
      float detected = detected_[a];
#pragma GCC unroll 2
      for (const Block& block : blocks) {
        const float range = distance(ends_[a], block.source);
        const Place of_way = place_of(way_of(block, ends_[a], range));
        const Place of_range = place_of(range);
        search_cost += block.probability * (of_way.sample.search_cost + of_way.beyond * of_way.sample.search_cost_rise);
        detected += block.probability * (of_range.sample.detected + of_range.beyond * of_range.sample.detected_rise);
      }
      search_cost_[a] = search_cost;
      detected_[a] = detected;
    }
    for (const Block& block : blocks) probability_ += block.probability;
  }

  const RangeSample* samples_;
  float last_;  ///< of them
  float per_range_step_;
  std::size_t action_count_;
  float probability_ = 0.0F;  ///< of all blocks that were added
  std::array<Point, config::kMaxActions> ends_;
  std::array<float, config::kMaxActions> search_cost_{};
  std::array<float, config::kMaxActions> detected_{};
};

Expectations expectations_over(const Grid& grid, const BeliefModel& model, const BorderFreeArea& inside, const ValuesByRange& by_range,
                               Point vehicle) {
  Expectations expectations(model, by_range, vehicle);
  LikelyBlocks likely(grid, inside, static_cast<float>(model.step_length.value));
  while (true) {
    const std::span<const Block> blocks = likely.next();
    if (blocks.empty()) return expectations;
    likely.are_outside_border() ? expectations.add_outside_border(blocks) : expectations.add(blocks);
  }
}

/// regret_a = min(cost_a - min over a' of cost_a', most_regret)
void find_regrets(const BeliefCosts& costs, const Expectations& expectations, std::span<ActionValues> action_values) {
  std::array<float, config::kMaxActions> cost;
  for (std::size_t a = 0; a < action_values.size(); ++a) {
    cost[a] =
        expectations.search_cost(a) + costs.edge * action_values[a].border - costs.find_probability * action_values[a].find_probability;
  }
  const float least = *std::min_element(cost.begin(), cost.begin() + static_cast<std::ptrdiff_t>(action_values.size()));
  for (std::size_t a = 0; a < action_values.size(); ++a) action_values[a].regret = std::min(cost[a] - least, costs.most_regret);
}

}  // namespace

void find_search_cost(const BeliefModel& model, Meters range_step, float silence_discount, std::span<const float> detected,
                      std::span<float> search_cost) {
  const std::size_t count = detected.size();
  const auto step = std::clamp<std::size_t>(static_cast<std::size_t>(model.step_length / range_step + 0.5), 1, count);
  const float discount = exp(model.costs.log_step_discount / static_cast<float>(step));
  const float discounted_away = 1.0F - exp(model.costs.log_step_discount);
  float discounted = 1.0F;
  std::array<float, config::kMaxTableRanges> silent;  // expected steps without detection
  for (std::size_t i = 0; i < count; ++i) {
    silent[i] = 0.0F;
    if (i > step) {
      const float steps = static_cast<float>(i - step) / static_cast<float>(step);
      silent[i] = (1.0F - detected[i]) * std::min(1.0F, steps) + silence_discount * silent[i - step];
      discounted *= discount;
    }
    search_cost[i] = silent[i] + model.costs.step * (1.0F - discounted) / discounted_away;
  }
}

void find_samples(std::span<const float> search_cost, std::span<const float> detected, std::span<RangeSample> samples) {
  const std::size_t last = samples.size() - 1;
  for (std::size_t i = 0; i < last; ++i)
    samples[i] = {search_cost[i], search_cost[i + 1] - search_cost[i], detected[i], detected[i + 1] - detected[i]};
  samples[last] = {search_cost[last], 0.0F, detected[last], 0.0F};
}

EARSHOT_WIDE void find_action_values(const BeliefModel& model, std::span<const float> probabilities, const ValuesByRange& by_range,
                                     NorthEast position, std::span<ActionValues> action_values) {
  const Point vehicle = point_at(position);
  const BorderFreeArea inside(model);
  const Grid grid(model, probabilities);
  const auto step_length = static_cast<float>(model.step_length.value);
  const Expectations expectations = expectations_over(grid, model, inside, by_range, vehicle);
  const NearCells near(grid, vehicle, (1.5F + static_cast<float>(kFindSteps)) * step_length);
  for (std::size_t a = 0; a < action_values.size(); ++a) {
    const Point end = expectations.end(a);
    action_values[a] = {
        .found = near.probability_within(end, step_length), .detected = expectations.detected(a), .border = inside.border_depth(end)};
  }
  if (near.probability() >= kLeastNearProbability) FindProbabilitySearch(model, near, inside).search_from(vehicle, action_values);
  find_regrets(model.costs, expectations, action_values);
}

}  // namespace earshot::policy
