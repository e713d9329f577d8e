#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "policy/baselines/bayes.hpp"

namespace earshot::baselines {

/// Plans a path with a genetic algorithm over what is believed about the source's place, takes its first step, and plans anew after the
/// measurement (receding horizon), beginning with what is left of the last plan.
///
/// A path is a string of actions. It costs what the border takes, one for every step before the source is found, and for what is then still
/// not found the distance that remains to it. Selection by tournaments of two, crossover at one point, mutation of single actions, the best
/// two live on.
/// Source: the alternative that Clark et al. 2022 name; there for planning sensors' paths, open loop.   Oracle: Genetic.*
class Genetic : public Bayes {
 public:
  static constexpr std::size_t kHorizon = 24;  ///< steps of a path: the domain from side to side
  using Path = std::array<std::size_t, kHorizon>;

  explicit Genetic(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  struct Planned {
    Path path;
    double cost;
  };

  void take_cells();
  [[nodiscard]] double cost_of(const Path& path, NorthEast position);
  [[nodiscard]] Planned planned(const Path& path, NorthEast position) { return {path, cost_of(path, position)}; }
  [[nodiscard]] Path drawn();
  [[nodiscard]] Path straight_to_likeliest(NorthEast position) const;
  [[nodiscard]] const Path& chosen_parent();
  [[nodiscard]] Path child();

  Pcg32 random_{0};
  std::vector<Planned> population_;
  std::vector<double> probability_;      ///< [cell], those of the belief
  std::vector<std::size_t> covered_in_;  ///< [cell]: the last path that covered it, counted by paths_
  std::size_t paths_ = 0;
  NorthEast mean_;
  Path plan_{};
  bool has_plan_ = false;
};

}  // namespace earshot::baselines
