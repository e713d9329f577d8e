#include "policy/baselines/infotaxis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"
#include "policy/baselines/moves.hpp"
#include "policy/baselines/space_aware_cost.hpp"

namespace earshot::baselines {
namespace {

using policy::kLanes;
using policy::OceanBelief;

constexpr double kBin_db = 2.0;
/// Less than it no measurement need tell before one was too faint to measure.
constexpr double kUnknownFloor_db = -20.0;
/// A hypothesis, or a place, less likely than this changes no decision.
constexpr float kLeastShare = 1e-3F;
constexpr float kLeastProbability = 1e-8F;

/// So many cells in a row are about a step length.
std::size_t cells_in(Meters step_length, double cell_m) {
  return static_cast<std::size_t>(std::max(1.0, std::round(step_length.value / cell_m)));
}

}  // namespace

Infotaxis::Infotaxis(const PriorKnowledge& prior) : OceanSearch(prior), floor_db_(kUnknownFloor_db) {
  const std::size_t group_north = cells_in(model_.step_length, policy::cell_north(model_));
  const std::size_t group_east = cells_in(model_.step_length, policy::cell_east(model_));
  places_east_ = (model_.cells_east + group_east - 1) / group_east;
  const std::size_t places = (model_.cells_north + group_north - 1) / group_north * places_east_;
  centres_.resize(places);
  std::vector<double> cells(places);
  for (std::size_t i = 0; i < cell_count(model_); ++i) {
    const std::size_t place = i / model_.cells_east / group_north * places_east_ + i % model_.cells_east / group_east;
    place_of_.push_back(place);
    centres_[place] = centres_[place] + policy::way_to_cell(model_, {}, i);
    cells[place] += 1.0;
  }
  for (std::size_t i = 0; i < places; ++i) centres_[i] = {centres_[i].north / cells[i], centres_[i].east / cells[i]};
  ranges_.resize(cell_count(model_));
  uncovered_.resize(tables_.range_count);
  policy::find_uncovered(model_, tables_.range_step, uncovered_);
  outcomes_.resize(OceanBelief::kHypotheses * tables_.range_count);
  place_outcomes_.resize(places * kOutcomes);
  distance_steps_.resize(places);
}

void Infotaxis::begin(Pcg32 random) {
  OceanSearch::begin(random);
  floor_db_ = kUnknownFloor_db;
}

std::size_t Infotaxis::choose(const DecisionInput& input) {
  hear(input);
  if (input.reception.too_faint) floor_db_ = input.reception.snr.value;
  foresee();
  std::size_t best = straight_toward(prior_, input.position, prior_.settings.domain.south_west + belief_.summary().likeliest);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t action = 0; action < prior_.actions.size(); ++action) {
    const NorthEast end = end_of(prior_, input.position, action);
    if (!prior_.settings.domain.contains(end)) continue;
    const double cost = expected_cost(end);
    if (cost < least) {
      least = cost;
      best = action;
    }
  }
  return best;
}

/// What is the same for every step: how likely place and hypothesis are together, and what would then be heard.
void Infotaxis::foresee() {
  likely_.clear();
  joint_.clear();
  for (std::size_t h = 0; h < OceanBelief::kHypotheses; ++h) {
    if (belief_.share(h) < kLeastShare) continue;
    likely_.push_back(h);
    joint_.emplace_back(cell_count(model_));
    belief_.add_joint(model_, h, joint_.back());
  }
  tabulate_outcomes();
}

void Infotaxis::tabulate_outcomes() {
  const std::size_t ranges = tables_.range_count;
  for (std::size_t first = 0; first < OceanBelief::kHypotheses; first += kLanes) {
    std::array<policy::Hypothesis, kLanes> hypotheses;
    for (std::size_t l = 0; l < kLanes; ++l) hypotheses[l] = belief_.hypothesis(first + l);
    for (std::size_t z = 0; z < kOutcomes; ++z) {
      const double middle_db = floor_db_ + (static_cast<double>(z) - 0.5) * kBin_db;
      const policy::Reception heard =
          z == 0 ? policy::Reception{.snr = Decibels{floor_db_}, .too_faint = true} : policy::Reception{.snr = Decibels{middle_db}};
      likelihoods_.tabulate(model_, tables_, hypotheses, heard, tables_.range_count);
      const auto width = static_cast<float>(z == 0 ? 1.0 : kBin_db);
      const std::span<const policy::LogLanes> raised = likelihoods_.raised_by_range();
      for (std::size_t l = 0; l < kLanes; ++l) {
        for (std::size_t r = 0; r < ranges; ++r)
          outcomes_[(first + l) * ranges + r][z] = width * policy::from_log(raised[r][l] + policy::kLeastLogLikelihood);
      }
    }
  }
}

double Infotaxis::expected_cost(NorthEast place) {
  const NorthEast end = place - prior_.settings.domain.south_west;
  policy::CellPlaces cells;
  cells.find(model_, {}, 0, {});
  cells.find_ranges(model_, end, tables_.range_step, tables_.range_count - std::size_t{1}, ranges_);
  for (std::size_t i = 0; i < centres_.size(); ++i)
    distance_steps_[i] = static_cast<float>(std::max(1.0, range_between(end, centres_[i]) / model_.step_length));
  std::ranges::fill(place_outcomes_, 0.0F);
  double all = 0.0;
  double left = 0.0;  // of it, what is not found
  for (std::size_t i = 0; i < place_of_.size(); ++i) {
    float* const at_place = &place_outcomes_[place_of_[i] * kOutcomes];
    for (std::size_t k = 0; k < likely_.size(); ++k) {
      const float p = joint_[k][i];
      if (p < kLeastProbability) continue;
      all += static_cast<double>(p);
      left += static_cast<double>(p * uncovered_[ranges_[i]]);
      const std::array<float, kOutcomes>& then = outcomes_[likely_[k] * tables_.range_count + ranges_[i]];
      for (std::size_t z = 0; z < kOutcomes; ++z) at_place[z] += p * then[z];
    }
  }
  // A density times the width of a bin is its probability but for a hundredth or two.
  const double heard = std::accumulate(place_outcomes_.begin(), place_outcomes_.end(), 0.0);
  const auto scale = static_cast<float>(left / (all * heard));
  for (float& p : place_outcomes_) p *= scale;
  return expected_space_aware_cost(place_outcomes_, distance_steps_);
}

}  // namespace earshot::baselines
