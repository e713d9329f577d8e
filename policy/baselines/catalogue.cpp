#include "policy/baselines/catalogue.hpp"

#include <array>

#include "policy/baselines/bayes.hpp"
#include "policy/baselines/genetic.hpp"
#include "policy/baselines/gradient.hpp"
#include "policy/baselines/infotaxis.hpp"
#include "policy/baselines/oracle.hpp"
#include "policy/baselines/patterns.hpp"

namespace earshot::baselines {
namespace {

using Make = std::unique_ptr<Searcher> (*)(const PriorKnowledge&);

template <class S>
std::unique_ptr<Searcher> make(const PriorKnowledge& prior) {
  return std::make_unique<S>(prior);
}

template <Border border>
std::unique_ptr<Searcher> make_oracle(const PriorKnowledge& prior) {
  return std::make_unique<Oracle>(prior, border);
}

constexpr std::array kCatalogue{
    Entry{"oracle", "knows the source and goes straight to it, heedless of the border"},
    Entry{"oracle_lookahead", "knows the source, considers the border one step ahead"},
    Entry{"random", "random walk"},
    Entry{"lawn_mower", "parallel tracks, twice the assured detection range apart"},
    Entry{"sweep", "parallel tracks over all of the area, two step lengths apart: what a vehicle falls back to"},
    Entry{"expanding_square", "square spiral about the start, tracks two step lengths apart"},
    Entry{"gradient", "goes on while it grows louder, turns when it grows fainter"},
    Entry{"bayes", "belief in the known ocean, goes to the likeliest cell", true},
    Entry{"bayes_least_regret", "the same belief, takes the action that it expects to cost least", true},
    Entry{"ocean_search", "belief over place and ocean, takes the action that it expects to cost least"},
    Entry{"infotaxis", "the belief of ocean_search, takes the step after which least is expected to be left to search (space-aware)"},
    Entry{"genetic", "the same belief, path planned by a genetic algorithm anew after every step"},
};

constexpr std::array<Make, kCatalogue.size()> kMakers{make_oracle<Border::kIgnored>,
                                                      make_oracle<Border::kSeenOneStepAhead>,
                                                      make<RandomWalk>,
                                                      make<LawnMower>,
                                                      make<SweepSearch>,
                                                      make<ExpandingSquare>,
                                                      make<GradientClimb>,
                                                      make<Bayes>,
                                                      make<BayesLeastRegret>,
                                                      make<OceanSearch>,
                                                      make<Infotaxis>,
                                                      make<Genetic>};

}  // namespace

std::span<const Entry> catalogue() {
  return kCatalogue;
}

std::unique_ptr<Searcher> make_baseline(std::string_view name, const PriorKnowledge& prior) {
  for (std::size_t i = 0; i < kCatalogue.size(); ++i) {
    if (kCatalogue[i].name == name) return kMakers[i](prior);
  }
  return nullptr;
}

}  // namespace earshot::baselines
