#include "firmware/policy/belief_outlook.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {
namespace {

/// Cells on the side of a block: a cost of kilometres needs no finer grid.
constexpr std::size_t kBlock = 2;
/// A block less likely than this changes no decision.
constexpr float kLeastBlockProbability = 2e-4F;
/// Where the source is less likely than this to be near, the reach is not computed.
constexpr float kLeastNearProbability = 0.01F;

/// A place in metres from the south-west corner. Floats are exact enough.
struct Point {
  float north;
  float east;
  friend bool operator==(const Point&, const Point&) = default;
};

float distance(Point a, Point b) {
  const float north = a.north - b.north;
  const float east = a.east - b.east;
  return __builtin_sqrtf(north * north + east * east);
}

Point point_at(NorthEast place) {
  return {static_cast<float>(place.north.value), static_cast<float>(place.east.value)};
}

/// The search area without its border, and B(y), how deep a place lies in the border.
struct BorderFreeArea {
  Point low;
  Point high;
  float width;  ///< of the border

  explicit BorderFreeArea(const BeliefModel& model)
      : low{static_cast<float>(model.border_width.value), static_cast<float>(model.border_width.value)},
        high{static_cast<float>((model.area_size.north - model.border_width).value),
             static_cast<float>((model.area_size.east - model.border_width).value)},
        width(static_cast<float>(model.border_width.value)) {}

  /// B(y): 0 inside, 1 at the edge, more beyond.
  [[nodiscard]] float border_depth(Point p) const {
    const float north = std::max(low.north - p.north, p.north - high.north);
    const float east = std::max(low.east - p.east, p.east - high.east);
    return std::max(0.0F, std::max(north, east)) / width;
  }
  [[nodiscard]] Point nearest(Point p) const {
    return {std::max(low.north, std::min(p.north, high.north)), std::max(low.east, std::min(p.east, high.east))};
  }
};

/// A block of cells, whose probability is taken to lie in one point s.
struct Block {
  Point source;       ///< s
  Point goal;         ///< c: the place outside the border nearest to s
  float extra_way;    ///< l - sqrt(l^2 - |s - c|^2), m: how much nearer to c than a step length the vehicle must come to find s
  float probability;  ///< b(s)
  /// Whether the way to it goes straight to s.
  [[nodiscard]] bool is_outside_border() const { return goal == source; }
};

Block block_at(const BorderFreeArea& inside, Point source, float probability, float step_length) {
  const Point goal = inside.nearest(source);
  const float off = distance(source, goal);
  const float to_goal = off < step_length ? __builtin_sqrtf(step_length * step_length - off * off) : 0.0F;
  return {.source = source, .goal = goal, .extra_way = step_length - to_goal, .probability = probability};
}

/// The cells of the belief.
struct Grid {
  std::span<const float> probabilities;
  std::size_t rows;
  std::size_t columns;
  float size_north;
  float size_east;

  Grid(const BeliefModel& model, std::span<const float> of_cells)
      : probabilities(of_cells),
        rows(model.cells_north),
        columns(model.cells_east),
        size_north(static_cast<float>(model.area_size.north.value / static_cast<double>(model.cells_north))),
        size_east(static_cast<float>(model.area_size.east.value / static_cast<double>(model.cells_east))) {}

  /// Sums up those of the cells [row, row + 2) x [column, column + 2) that exist.
  /// @return their probability, and in `centre` their centre of mass; 0 where it is below kLeastBlockProbability
  [[nodiscard]] float block(std::size_t row, std::size_t column, Point& centre) const {
    const bool has_north = row + 1 < rows;
    const bool has_east = column + 1 < columns;
    const float* const south = &probabilities[row * columns + column];
    const float south_east = has_east ? south[1] : 0.0F;
    const float north_west = has_north ? south[columns] : 0.0F;
    const float north_east = has_north && has_east ? south[columns + 1] : 0.0F;
    const float sum = (south[0] + south_east) + (north_west + north_east);
    if (sum < kLeastBlockProbability) return 0.0F;
    centre = {(static_cast<float>(row) + 0.5F + (north_west + north_east) / sum) * size_north,
              (static_cast<float>(column) + 0.5F + (south_east + north_east) / sum) * size_east};
    return sum;
  }
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
    // Rows of cells that are further off than this add nothing.
    const float reach = step_length + 1.0F / per_size_;
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < count_; i += kLanes) {
      if (north_[i + kLanes - 1] < place.north - reach) continue;
      if (north_[i] > place.north + reach) break;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float north = north_[i + lane] - place.north;
        const float east = east_[i + lane] - place.east;
        const float covered = (step_length - __builtin_sqrtf(north * north + east * east)) * per_size_ + 0.5F;
        const float held = covered > 0.0F ? covered : 0.0F;
        sums[lane] += probabilities_[i + lane] * (held < 1.0F ? held : 1.0F);
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

/// Where a range lies in a table by range.
class RangePlace {
 public:
  [[gnu::always_inline]] RangePlace(float range_steps, std::size_t count)
      : is_in_(range_steps < static_cast<float>(count - 1)),
        index_(is_in_ ? static_cast<int>(range_steps) : 0),
        beyond_(range_steps - static_cast<float>(index_)) {}

  /// Linear between the samples.
  [[nodiscard, gnu::always_inline]] float value_of(std::span<const float> table) const {
    if (!is_in_) return table.back();
    const float* const before = table.data() + index_;
    return before[0] + beyond_ * (before[1] - before[0]);
  }

 private:
  bool is_in_;  ///< before the last sample
  int index_;
  float beyond_;  ///< in steps of the table
};

/// Searches the paths of 1 to kReachSteps steps for the best place to find the source at.
class ReachSearch {
 public:
  ReachSearch(const BeliefModel& model, const NearCells& near, const BorderFreeArea& inside)
      : model_(model),
        near_(near),
        inside_(inside),
        step_(static_cast<float>(model.step_length.value)),
        border_cost_(model.costs.edge / model.costs.reach) {}

  /// Raises each action's reach to that of the best end of a path from `start` of which it is a step. A path's end does not depend on the
  /// order of its steps: of the paths a, b, c only those with a <= b <= c are searched. @param outlooks  [actions]
  void raise_reaches(Point start, std::span<ActionOutlook> outlooks) const {
    static_assert(kReachSteps == 3);
    const std::size_t none = outlooks.size();  // no step: the path is shorter
    const float discount = model_.costs.reach_discount;
    for (std::size_t a = 0; a < none; ++a) {
      const Point first_end = end_of_step(start, a);
      for (std::size_t b = a; b <= none; ++b) {
        const Point second_end = b < none ? end_of_step(first_end, b) : first_end;
        const float second = b < none ? discount : 1.0F;
        for (std::size_t c = b; c <= none; ++c) {
          const float reach = discounted_reach(c < none ? end_of_step(second_end, c) : second_end, c < none ? second * discount : second);
          raise(outlooks[a], reach);
          if (b < none) raise(outlooks[b], reach);
          if (c < none) raise(outlooks[c], reach);
        }
      }
    }
  }

 private:
  static void raise(ActionOutlook& outlook, float reach) { outlook.reach = std::max(outlook.reach, reach); }

  [[nodiscard]] Point end_of_step(Point from, std::size_t action) const {
    return {from.north + step_ * static_cast<float>(model_.actions[action].north),
            from.east + step_ * static_cast<float>(model_.actions[action].east)};
  }

  /// g^(n-1) P(|s - y| <= l) - (e / r) B(y); 0 where that is negative whatever P is.
  [[nodiscard]] float discounted_reach(Point end, float discount) const {
    const float border_cost = inside_.border_depth(end) * border_cost_;
    return border_cost >= discount ? 0.0F : discount * near_.probability_within(end, step_) - border_cost;
  }

  const BeliefModel& model_;
  const NearCells& near_;
  const BorderFreeArea& inside_;
  float step_;
  float border_cost_;  ///< e / r: of the border at the edge, in units of a reach of one
};

/// The expectations E[C(way(x_a, s))] and E[D(|s - x_a|)] of every action a, summed up block by block and side by side for a vector unit.
class Expectations {
 public:
  Expectations(const BeliefModel& model, Meters range_step, Point vehicle)
      : count_(model.actions.size()), per_range_step_(static_cast<float>(1.0 / range_step.value)) {
    const auto step = static_cast<float>(model.step_length.value);
    for (std::size_t a = 0; a < count_; ++a) {
      north_[a] = vehicle.north + step * static_cast<float>(model.actions[a].north);
      east_[a] = vehicle.east + step * static_cast<float>(model.actions[a].east);
    }
  }

  /// x_a
  [[nodiscard]] Point end(std::size_t action) const { return {north_[action], east_[action]}; }

  void add(const Block& block, const RangeOutlook& by_range) {
    const std::size_t count = by_range.detected.size();
    std::array<float, config::kMaxActions> ranges;  // |s - x_a|
    for (std::size_t a = 0; a < count_; ++a) ranges[a] = distance(end(a), block.source);
    probability_ += block.probability;
    if (block.is_outside_border()) {
      for (std::size_t a = 0; a < count_; ++a) {
        const RangePlace range(ranges[a] * per_range_step_, count);
        search_cost_[a] += block.probability * range.value_of(by_range.search_cost);
        detected_[a] += block.probability * range.value_of(by_range.detected);
      }
      return;
    }
    for (std::size_t a = 0; a < count_; ++a) {
      const float straight = distance(end(a), block.goal) + block.extra_way;
      const float way = straight > ranges[a] ? straight : ranges[a];  // way(x_a, s)
      search_cost_[a] += block.probability * RangePlace(way * per_range_step_, count).value_of(by_range.search_cost);
      detected_[a] += block.probability * RangePlace(ranges[a] * per_range_step_, count).value_of(by_range.detected);
    }
  }

  [[nodiscard]] float search_cost(std::size_t action) const { return probability_ > 0.0F ? search_cost_[action] / probability_ : 0.0F; }
  [[nodiscard]] float detected(std::size_t action) const { return probability_ > 0.0F ? detected_[action] / probability_ : 0.0F; }

 private:
  std::size_t count_;
  float per_range_step_;
  float probability_ = 0.0F;  ///< of all blocks that were added
  std::array<float, config::kMaxActions> north_{};
  std::array<float, config::kMaxActions> east_{};
  std::array<float, config::kMaxActions> search_cost_{};
  std::array<float, config::kMaxActions> detected_{};
};

Expectations expectations_over(const Grid& grid, const BeliefModel& model, const BorderFreeArea& inside, const RangeOutlook& by_range,
                               Point vehicle) {
  const auto step_length = static_cast<float>(model.step_length.value);
  Expectations expectations(model, by_range.range_step, vehicle);
  for (std::size_t row = 0; row < grid.rows; row += kBlock) {
    for (std::size_t column = 0; column < grid.columns; column += kBlock) {
      Point source{};
      const float probability = grid.block(row, column, source);
      if (probability > 0.0F) expectations.add(block_at(inside, source, probability, step_length), by_range);
    }
  }
  return expectations;
}

/// regret_a = min(cost_a - min over a' of cost_a', most_regret)
void find_regrets(const BeliefCosts& costs, const Expectations& expectations, std::span<ActionOutlook> outlooks) {
  std::array<float, config::kMaxActions> cost;
  for (std::size_t a = 0; a < outlooks.size(); ++a) {
    cost[a] = expectations.search_cost(a) + costs.edge * outlooks[a].border - costs.reach * outlooks[a].reach;
  }
  const float least = *std::min_element(cost.begin(), cost.begin() + static_cast<std::ptrdiff_t>(outlooks.size()));
  for (std::size_t a = 0; a < outlooks.size(); ++a) outlooks[a].regret = std::min(cost[a] - least, costs.most_regret);
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

EARSHOT_WIDE void find_outlooks(const BeliefModel& model, std::span<const float> probabilities, const RangeOutlook& by_range,
                                NorthEast position, std::span<ActionOutlook> outlooks) {
  const Point vehicle = point_at(position);
  const BorderFreeArea inside(model);
  const Grid grid(model, probabilities);
  const auto step_length = static_cast<float>(model.step_length.value);
  const Expectations expectations = expectations_over(grid, model, inside, by_range, vehicle);
  const NearCells near(grid, vehicle, (1.5F + static_cast<float>(kReachSteps)) * step_length);
  for (std::size_t a = 0; a < outlooks.size(); ++a) {
    const Point end = expectations.end(a);
    outlooks[a] = {
        .found = near.probability_within(end, step_length), .detected = expectations.detected(a), .border = inside.border_depth(end)};
  }
  if (near.probability() >= kLeastNearProbability) ReachSearch(model, near, inside).raise_reaches(vehicle, outlooks);
  find_regrets(model.costs, expectations, outlooks);
}

}  // namespace earshot::policy
