#include "policy/baselines/genetic.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/policy/likelihood/belief_grid.hpp"
#include "policy/baselines/moves.hpp"

namespace earshot::baselines {
namespace {

constexpr std::size_t kPopulation = 32;
constexpr std::size_t kGenerations = 24;
constexpr std::size_t kElite = 2;
constexpr double kMutation = 1.5 / static_cast<double>(Genetic::kHorizon);  // of each action: one or two a child

/// Cells from the first whose centre lies at or beyond `low` to the last at or below `high`.
struct CellRange {
  std::size_t first;
  std::size_t end;
};
CellRange cells_between(Meters low, Meters high, Meters cell, std::size_t count) {
  const auto clamped = [count](double x) { return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(count))); };
  return {clamped(std::ceil(low / cell - 0.5)), clamped(std::floor(high / cell - 0.5) + 1.0)};
}

}  // namespace

Genetic::Genetic(const PriorKnowledge& prior) : Bayes(prior) {
  const std::size_t cells = std::size_t{model_.cells_north} * model_.cells_east;
  probability_.resize(cells);
  covered_in_.resize(cells);
}

void Genetic::begin(Pcg32 random) {
  Bayes::begin(random);
  random_ = random;
  has_plan_ = false;
}

std::size_t Genetic::choose(const DecisionInput& input) {
  hear(input);
  take_cells();
  population_.clear();
  population_.push_back(planned(straight_to_likeliest(input.position), input.position));
  if (has_plan_) {
    std::shift_left(plan_.begin(), plan_.end(), 1);
    population_.push_back(planned(plan_, input.position));
  }
  while (population_.size() < kPopulation) population_.push_back(planned(drawn(), input.position));
  for (std::size_t generation = 0; generation < kGenerations; ++generation) {
    std::ranges::sort(population_, {}, &Planned::cost);
    std::vector<Planned> next(population_.begin(), population_.begin() + kElite);
    while (next.size() < kPopulation) next.push_back(planned(child(), input.position));
    population_ = std::move(next);
  }
  plan_ = std::ranges::min_element(population_, {}, &Planned::cost)->path;
  has_plan_ = true;
  return plan_.front();
}

void Genetic::take_cells() {
  for (std::size_t north = 0; north < model_.cells_north; ++north) {
    for (std::size_t east = 0; east < model_.cells_east; ++east)
      probability_[north * model_.cells_east + east] = static_cast<double>(belief_.probability(model_, north, east));
  }
  mean_ = prior_.settings.domain.south_west + belief_.summary().mean;
}

double Genetic::cost_of(const Path& path, NorthEast position) {
  const Meters reach = model_.step_length;
  const Meters cell_north = model_.area_size.north / static_cast<double>(model_.cells_north);
  const Meters cell_east = model_.area_size.east / static_cast<double>(model_.cells_east);
  const NorthEast corner = prior_.settings.domain.south_west;
  ++paths_;
  double unfound = 1.0;
  double cost = 0.0;
  for (const std::size_t action : path) {
    cost += unfound;
    position = end_of(prior_, position, action);
    cost += unfound * border_cost(prior_.settings, position);
    const NorthEast p = position - corner;
    const CellRange rows = cells_between(p.north - reach, p.north + reach, cell_north, model_.cells_north);
    const CellRange columns = cells_between(p.east - reach, p.east + reach, cell_east, model_.cells_east);
    for (std::size_t north = rows.first; north < rows.end; ++north) {
      for (std::size_t east = columns.first; east < columns.end; ++east) {
        const std::size_t cell = north * model_.cells_east + east;
        if (covered_in_[cell] == paths_ || length_of(policy::way_to_cell(model_, p, cell)) > reach) continue;
        covered_in_[cell] = paths_;
        unfound -= probability_[cell];
      }
    }
  }
  return cost + std::max(unfound, 0.0) * (range_between(position, mean_) / reach + static_cast<double>(kHorizon));
}

Genetic::Path Genetic::drawn() {
  Path path{};
  std::size_t action = random_.next() % prior_.actions.size();
  for (std::size_t& step : path) {  // long straight legs: a random walk covers little
    if (random_.next() % 4 == 0) action = random_.next() % prior_.actions.size();
    step = action;
  }
  return path;
}

Genetic::Path Genetic::straight_to_likeliest(NorthEast position) const {
  const NorthEast place = prior_.settings.domain.south_west + belief_.summary().likeliest;
  Path path{};
  for (std::size_t& action : path) {
    action = warily_toward(prior_, position, place);
    position = end_of(prior_, position, action);
  }
  return path;
}

const Genetic::Path& Genetic::chosen_parent() {
  const Planned& a = population_[random_.next() % population_.size()];
  const Planned& b = population_[random_.next() % population_.size()];
  return a.cost <= b.cost ? a.path : b.path;
}

Genetic::Path Genetic::child() {
  Path path = chosen_parent();
  const Path& other = chosen_parent();
  const auto cut = static_cast<std::ptrdiff_t>(random_.next() % kHorizon);
  std::copy(other.begin() + cut, other.end(), path.begin() + cut);
  for (std::size_t& action : path) {
    if (random_.uniform_double() < kMutation) action = random_.next() % prior_.actions.size();
  }
  return path;
}

}  // namespace earshot::baselines
