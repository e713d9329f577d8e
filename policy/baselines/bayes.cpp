#include "policy/baselines/bayes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ranges>

#include "policy/baselines/moves.hpp"
#include "sim/search/belief_model.hpp"

namespace earshot::baselines {
namespace {

constexpr double kLowest_db = -60.0;  // lower edge of the first bin of SNR; values beyond either end count with the last bin there
constexpr double kBin_db = 2.0;
constexpr std::size_t kBins = 80;
using Histogram = std::array<double, kBins>;

/// A histogram of expected SNRs blurred by fluctuation.
Histogram blurred(const Histogram& expected, double spread_db) {
  const double spread = std::max(spread_db / kBin_db, 0.3);  // bins; less than a bin's own width would pretend to more than it tells
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * spread));
  std::vector<double> kernel;
  double sum = 0.0;
  for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) / spread;
    kernel.push_back(std::exp(-0.5 * x * x));
    sum += kernel.back();
  }
  Histogram result{};
  for (std::ptrdiff_t bin = 0; bin < std::ssize(expected); ++bin) {
    if (expected[static_cast<std::size_t>(bin)] == 0.0) continue;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
      const auto to = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(bin + i, 0, kBins - 1));
      result[to] += expected[static_cast<std::size_t>(bin)] * kernel[static_cast<std::size_t>(i + reach)] / sum;
    }
  }
  return result;
}

double entropy(double probability) {
  return probability > 0.0 ? -probability * std::log(probability) : 0.0;
}

double entropy(const Histogram& histogram) {
  double sum = 0.0;
  for (const double probability : histogram) sum += entropy(probability);
  return sum;
}

}  // namespace

Bayes::Bayes(const PriorKnowledge& prior) : prior_(prior), model_(search::belief_model(prior.settings, prior.snr)) {}

void Bayes::begin(Pcg32 /*random*/) {
  belief_.start(model_);
}

void Bayes::hear(const DecisionInput& input) {
  belief_.update(model_, input.position - prior_.settings.domain.south_west, input.reception);
}

std::size_t Bayes::choose(const DecisionInput& input) {
  hear(input);
  return chase(input);
}

std::size_t Bayes::chase(const DecisionInput& input) const {
  return warily_toward(prior_, input.position, prior_.settings.domain.south_west + belief_.summary().likeliest);
}

NorthEast Bayes::centre_of(std::size_t north, std::size_t east) const {
  const auto middle = [](std::size_t i, std::size_t cells, Meters length) {
    return ((static_cast<double>(i) + 0.5) / static_cast<double>(cells)) * length;
  };
  return prior_.settings.domain.south_west +
         NorthEast{middle(north, model_.cells_north, model_.area_size.north), middle(east, model_.cells_east, model_.area_size.east)};
}

std::size_t BayesLeastRegret::choose(const DecisionInput& input) {
  hear(input);
  const auto regret = [this](std::size_t action) { return belief_.outlook(action).regret; };
  return std::ranges::min(std::views::iota(std::size_t{0}, model_.actions.size()), {}, regret);
}

std::size_t BayesInformationGain::choose(const DecisionInput& input) {
  hear(input);
  const double cells = static_cast<double>(model_.cells_north) * static_cast<double>(model_.cells_east);
  const double cell_area = model_.area_size.north.value * model_.area_size.east.value / cells;
  const double covered = std::numbers::pi * model_.step_length.value * model_.step_length.value / cell_area;
  if (static_cast<double>(belief_.summary().effective_cells) <= covered) return chase(input);
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t action = 0; action < prior_.actions.size(); ++action) {
    const NorthEast end = end_of(prior_, input.position, action);
    const double worth = information_at(end) - border_cost(prior_.settings, end);
    if (worth > most) {
      most = worth;
      best = action;
    }
  }
  return best;
}

double BayesInformationGain::information_at(NorthEast place) const {
  Histogram expected{};
  double found = 0.0;
  for (std::size_t north = 0; north < model_.cells_north; ++north) {
    for (std::size_t east = 0; east < model_.cells_east; ++east) {
      const double probability = static_cast<double>(belief_.probability(model_, north, east));
      const Meters range = range_between(place, centre_of(north, east));
      if (range <= model_.step_length) {
        found += probability;
      } else {
        const double bin = (prior_.snr.at(range).value - kLowest_db) / kBin_db;
        expected[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)))] += probability;
      }
    }
  }
  Histogram certain{};
  certain[kBins / 2] = 1.0;
  return entropy(found) + entropy(blurred(expected, spread_db())) - (1.0 - found) * entropy(blurred(certain, spread_db()));
}

double BayesInformationGain::spread_db() const {
  double variance = 0.0;
  double sum = 0.0;
  for (std::size_t h = 0; h < model_.hypotheses.size(); ++h) {
    const double share = static_cast<double>(belief_.probability_of_hypothesis(h));
    const double spread = static_cast<double>(model_.hypotheses[h].spread_db);
    variance += share * spread * spread;
    sum += share;
  }
  return std::sqrt(variance / sum);
}

}  // namespace earshot::baselines
