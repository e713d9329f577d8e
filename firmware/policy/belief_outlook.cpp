// What follows from a belief: where the source is likeliest, and what each action promises.
#include <algorithm>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/belief.hpp"

namespace earshot::policy {
namespace {

constexpr std::size_t kBlock = 2;          // cells on the side of a block: a cost of kilometres needs no finer look
constexpr float kLeastBlockShare = 2e-4F;  // a block less likely changes no decision
constexpr float kLeastNearShare = 0.01F;   // a source less likely to be near needs no look at where it could be reached

/// A place in kilometres is exact enough, and short: floats, metres from the south-west corner.
struct Point {
  float north;
  float east;
};

float distance(Point a, Point b) {
  const float north = a.north - b.north;
  const float east = a.east - b.east;
  return __builtin_sqrtf(north * north + east * east);
}

Point point_at(NorthEast place) {
  return {static_cast<float>(place.north.value), static_cast<float>(place.east.value)};
}

/// The search area without its border.
struct Inside {
  Point low;
  Point high;
  float width;  ///< of the border

  explicit Inside(const BeliefModel& model)
      : low{static_cast<float>(model.border_width.value), static_cast<float>(model.border_width.value)},
        high{static_cast<float>((model.area_size.north - model.border_width).value),
             static_cast<float>((model.area_size.east - model.border_width).value)},
        width(static_cast<float>(model.border_width.value)) {}

  /// How deep a place lies in the border, 1 at the edge.
  [[nodiscard]] float depth(Point p) const {
    const float north = std::max(low.north - p.north, p.north - high.north);
    const float east = std::max(low.east - p.east, p.east - high.east);
    return std::max(0.0F, std::max(north, east)) / width;
  }
  [[nodiscard]] Point nearest(Point p) const {
    return {std::max(low.north, std::min(p.north, high.north)), std::max(low.east, std::min(p.east, high.east))};
  }
};

/// Some of the belief's probability, taken to lie in one point.
struct Block {
  Point source;
  Point goal;      ///< where to go for it without entering the border
  float handicap;  ///< how much nearer to the goal than a step length one must come to find it, m
  float share;
};

Block block_at(const Inside& inside, Point source, float share, float reach) {
  Block block{.source = source, .goal = inside.nearest(source), .handicap = 0.0F, .share = share};
  const float off = distance(block.source, block.goal);
  block.handicap = reach - (off < reach ? __builtin_sqrtf(reach * reach - off * off) : 0.0F);
  return block;
}

/// Walks over the cells of the belief.
struct Grid {
  std::span<const float> shares;
  std::size_t rows;
  std::size_t columns;
  float size_north;
  float size_east;

  Grid(const BeliefModel& model, std::span<const float> marginal)
      : shares(marginal),
        rows(model.cells_north),
        columns(model.cells_east),
        size_north(static_cast<float>(model.area_size.north.value / static_cast<double>(model.cells_north))),
        size_east(static_cast<float>(model.area_size.east.value / static_cast<double>(model.cells_east))) {}

  /// Sums up the cells [row, row + 2) x [column, column + 2), those that there are.
  /// @return their share and, when it is worth looking at, their centre of mass; else a share of zero
  [[nodiscard]] float block(std::size_t row, std::size_t column, Point& centre) const {
    const bool has_north = row + 1 < rows;
    const bool has_east = column + 1 < columns;
    const float* const south = &shares[row * columns + column];
    const float south_east = has_east ? south[1] : 0.0F;
    const float north_west = has_north ? south[columns] : 0.0F;
    const float north_east = has_north && has_east ? south[columns + 1] : 0.0F;
    const float share = (south[0] + south_east) + (north_west + north_east);
    if (share < kLeastBlockShare) return 0.0F;
    centre = {(static_cast<float>(row) + 0.5F + (north_west + north_east) / share) * size_north,
              (static_cast<float>(column) + 0.5F + (south_east + north_east) / share) * size_east};
    return share;
  }

  /// The cells along one axis whose centres can lie within `reach` of `place`: the first, and one past the last.
  struct Slice {
    std::size_t first;
    std::size_t last;
  };
  [[nodiscard]] static Slice slice(float place, float reach, float size, std::size_t count) {
    const auto index = [count](float cell) -> std::size_t {
      if (!(cell > 0.0F)) return 0;
      return cell < static_cast<float>(count) ? static_cast<std::size_t>(cell) : count;  // infinite for a fix beyond any area
    };
    return {index((place - reach) / size - 0.5F), index((place + reach) / size + 0.5F)};
  }
};

/// The cells near the vehicle that matter, side by side for a vector unit.
class Surroundings {
 public:
  Surroundings(const Grid& grid, Point vehicle, float radius) : per_size_(1.0F / std::max(grid.size_north, grid.size_east)) {
    // No more than 1 / least cells can have the least share of the last attempt: they fit.
    static_assert(kCapacity * kLeastNearCell * 16.0F >= 1.0F);
    for (float least = kLeastNearCell; !gather(grid, vehicle, radius, least) && least < 1.0F; least *= 4.0F) {
    }
  }

  /// Probability within `reach` of a place; a cell counts by as much of it as lies within.
  [[nodiscard]] float within(Point place, float reach) const {
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < count_; i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float north = north_[i + lane] - place.north;
        const float east = east_[i + lane] - place.east;
        const float covered = (reach - __builtin_sqrtf(north * north + east * east)) * per_size_ + 0.5F;
        const float held = covered > 0.0F ? covered : 0.0F;
        sums[lane] += shares_[i + lane] * (held < 1.0F ? held : 1.0F);
      }
    }
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  }

  [[nodiscard]] float share() const { return share_; }

 private:
  static constexpr std::size_t kLanes = 8;
  static constexpr std::size_t kCapacity = 64;
  static constexpr float kLeastNearCell = 1e-3F;

  /// False when more than kCapacity cells have `least` or more.
  bool gather(const Grid& grid, Point vehicle, float radius, float least) {
    count_ = 0;
    share_ = 0.0F;
    const Grid::Slice north = Grid::slice(vehicle.north, radius, grid.size_north, grid.rows);
    const Grid::Slice east = Grid::slice(vehicle.east, radius, grid.size_east, grid.columns);
    for (std::size_t n = north.first; n < north.last; ++n) {
      for (std::size_t e = east.first; e < east.last; ++e) {
        const float share = grid.shares[n * grid.columns + e];
        if (share < least) continue;
        if (count_ == kCapacity) return false;
        north_[count_] = (static_cast<float>(n) + 0.5F) * grid.size_north;
        east_[count_] = (static_cast<float>(e) + 0.5F) * grid.size_east;
        shares_[count_] = share;
        share_ += share;
        ++count_;
      }
    }
    for (; count_ % kLanes != 0; ++count_) {
      north_[count_] = 0.0F;
      east_[count_] = 0.0F;
      shares_[count_] = 0.0F;
    }
    return true;
  }

  std::array<float, kCapacity> north_;
  std::array<float, kCapacity> east_;
  std::array<float, kCapacity> shares_;
  std::size_t count_ = 0;
  float share_ = 0.0F;
  float per_size_;
};

/// Linear between the samples of a table by range.
float at_range(std::span<const float> table, float range_steps) {
  const auto end = static_cast<float>(table.size() - 1);
  if (!(range_steps < end)) return table.back();
  const auto index = static_cast<std::size_t>(static_cast<int>(range_steps));
  return table[index] + (range_steps - static_cast<float>(static_cast<int>(range_steps))) * (table[index + 1] - table[index]);
}

/// The best place to be found at within kReachSteps steps, and the steps that lead there in any order.
class Reach {
 public:
  Reach(const BeliefModel& model, const Surroundings& surroundings, const Inside& inside)
      : model_(model),
        surroundings_(surroundings),
        inside_(inside),
        step_(static_cast<float>(model.step_length.value)),
        edge_(model.costs.edge / model.costs.reach) {}

  /// Raises each action's reach to that of the best place that it can be a step towards. @param outlooks  [actions]
  void look(Point start, std::span<ActionOutlook> outlooks) const {
    static_assert(kReachSteps == 3);
    const std::size_t count = outlooks.size();
    const float later = model_.costs.reach_discount;
    for (std::size_t a = 0; a < count; ++a) {
      const Point one = after(start, a);
      const float first = worth(one, 1.0F);
      raise(outlooks[a], first);
      for (std::size_t b = a; b < count; ++b) {
        const Point two = after(one, b);
        const float second = worth(two, later);
        raise(outlooks[a], second);
        raise(outlooks[b], second);
        for (std::size_t c = b; c < count; ++c) {
          const float third = worth(after(two, c), later * later);
          raise(outlooks[a], third);
          raise(outlooks[b], third);
          raise(outlooks[c], third);
        }
      }
    }
  }

 private:
  static void raise(ActionOutlook& outlook, float worth) { outlook.reach = std::max(outlook.reach, worth); }

  [[nodiscard]] Point after(Point from, std::size_t action) const {
    return {from.north + step_ * static_cast<float>(model_.actions[action].north),
            from.east + step_ * static_cast<float>(model_.actions[action].east)};
  }

  [[nodiscard]] float worth(Point place, float discount) const {
    const float border = inside_.depth(place) * edge_;
    return border >= discount ? 0.0F : discount * surroundings_.within(place, step_) - border;
  }

  const BeliefModel& model_;
  const Surroundings& surroundings_;
  const Inside& inside_;
  float step_;
  float edge_;  ///< the border's cost at the edge, as a part of a reach of one
};

/// What each action's end makes of a part of the belief, side by side for a vector unit.
class Ways {
 public:
  Ways(const BeliefModel& model, Point vehicle)
      : count_(model.actions.size()), per_range_step_(static_cast<float>(1.0 / model.range_step.value)) {
    const auto step = static_cast<float>(model.step_length.value);
    for (std::size_t a = 0; a < count_; ++a) {
      north_[a] = vehicle.north + step * static_cast<float>(model.actions[a].north);
      east_[a] = vehicle.east + step * static_cast<float>(model.actions[a].east);
    }
  }

  [[nodiscard]] Point end(std::size_t action) const { return {north_[action], east_[action]}; }

  void add(const Block& block, std::span<const float> cost, std::span<const float> detected) {
    std::array<float, config::kMaxActions> ranges;  // to the source
    std::array<float, config::kMaxActions> ways;    // to where it is found
    for (std::size_t a = 0; a < count_; ++a) {
      ranges[a] = distance(end(a), block.source);
      const float way = distance(end(a), block.goal) + block.handicap;
      ways[a] = (way > ranges[a] ? way : ranges[a]) * per_range_step_;
      ranges[a] *= per_range_step_;
    }
    for (std::size_t a = 0; a < count_; ++a) {
      cost_[a] += block.share * at_range(cost, ways[a]);
      detected_[a] += block.share * at_range(detected, ranges[a]);
    }
    share_ += block.share;
  }

  /// Mean over all that was added.
  [[nodiscard]] float cost(std::size_t action) const { return share_ > 0.0F ? cost_[action] / share_ : 0.0F; }
  [[nodiscard]] float detected(std::size_t action) const { return share_ > 0.0F ? detected_[action] / share_ : 0.0F; }

 private:
  std::size_t count_;
  float per_range_step_;
  float share_ = 0.0F;
  std::array<float, config::kMaxActions> north_{};
  std::array<float, config::kMaxActions> east_{};
  std::array<float, config::kMaxActions> cost_{};
  std::array<float, config::kMaxActions> detected_{};
};

}  // namespace

EARSHOT_WIDE void Belief::summarise(const BeliefModel& model) {
  const std::size_t rows = model.cells_north;
  const std::size_t columns = model.cells_east;
  std::array<double, 3> north{};  // moments of the place, in cells, that many times
  std::array<double, 3> east{};
  double squares = 0.0;
  std::size_t best = 0;
  for (std::size_t n = 0; n < rows; ++n) {
    float row = 0.0F;
    float row_east = 0.0F;
    float row_east_squared = 0.0F;
    float row_squares = 0.0F;
    for (std::size_t e = 0; e < columns; ++e) {
      const std::size_t i = n * columns + e;
      const float p = marginal_[i];
      const auto column = static_cast<float>(static_cast<int>(e));
      row += p;
      row_east += p * column;
      row_east_squared += p * column * column;
      row_squares += p * p;
      best = p > marginal_[best] ? i : best;
    }
    const auto place = static_cast<double>(n);
    const auto share = static_cast<double>(row);
    north = {north[0] + share, north[1] + share * place, north[2] + share * place * place};
    east = {north[0], east[1] + double{row_east}, east[2] + double{row_east_squared}};
    squares += double{row_squares};
  }
  const Meters size_north = model.area_size.north / static_cast<double>(rows);
  const Meters size_east = model.area_size.east / static_cast<double>(columns);
  const double mean_north = north[1] / north[0];
  const double mean_east = east[1] / north[0];
  const double variance_north = std::max(0.0, north[2] / north[0] - mean_north * mean_north);
  const double variance_east = std::max(0.0, east[2] / north[0] - mean_east * mean_east);
  summary_.likeliest = {(static_cast<double>(best / columns) + 0.5) * size_north, (static_cast<double>(best % columns) + 0.5) * size_east};
  summary_.mean = {(mean_north + 0.5) * size_north, (mean_east + 0.5) * size_east};
  summary_.spread = length_of({sqrt(variance_north) * size_north, sqrt(variance_east) * size_east});
  summary_.likeliest_share = marginal_[best];
  summary_.effective_cells = static_cast<float>(1.0 / squares);
}

EARSHOT_WIDE void Belief::look_out(const BeliefModel& model, NorthEast position) {
  const Point vehicle = point_at(position);
  const Inside inside(model);
  const Grid grid(model, std::span(marginal_).first(std::size_t{model.cells_north} * model.cells_east));
  const auto reach = static_cast<float>(model.step_length.value);
  Ways ways(model, vehicle);
  for (std::size_t row = 0; row < grid.rows; row += kBlock) {
    for (std::size_t column = 0; column < grid.columns; column += kBlock) {
      Point source{};
      const float share = grid.block(row, column, source);
      if (share > 0.0F) {
        ways.add(block_at(inside, source, share, reach), std::span(cost_).first(model.snr_db.size()),
                 std::span(detected_).first(model.snr_db.size()));
      }
    }
  }
  const Surroundings surroundings(grid, vehicle, (1.5F + static_cast<float>(kReachSteps)) * reach);
  const std::span<ActionOutlook> outlooks = std::span(outlooks_).first(model.actions.size());
  for (std::size_t a = 0; a < outlooks.size(); ++a) {
    outlooks[a] = {.found = surroundings.within(ways.end(a), reach), .detected = ways.detected(a), .border = inside.depth(ways.end(a))};
  }
  if (surroundings.share() >= kLeastNearShare) Reach(model, surroundings, inside).look(vehicle, outlooks);

  std::array<float, config::kMaxActions> costs;
  for (std::size_t a = 0; a < outlooks.size(); ++a) {
    costs[a] = ways.cost(a) + model.costs.edge * outlooks[a].border - model.costs.reach * outlooks[a].reach;
  }
  const float least = *std::min_element(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(outlooks.size()));
  for (std::size_t a = 0; a < outlooks.size(); ++a) outlooks[a].regret = std::min(costs[a] - least, model.costs.most_regret);
}

}  // namespace earshot::policy
