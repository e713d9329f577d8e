#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "policy/baselines/bayes.hpp"

namespace earshot::baselines {

/// Space-aware infotaxis over the belief of OceanSearch: the step after which J (space_aware_cost) is expected to be least, over all that
/// may come of it: found, too faint to measure, or an SNR in bins of 2 dB. A step that ends outside the domain is never taken while
/// another is left; the border's penalty counts for nothing, for J knows no reward.
///
/// A place is as many cells as are a step length long; the distance is that of the crow. How likely an outcome is, the belief says itself
/// (LaneLikelihoods), but for whether the source moves during the step. The floor is that of the last measurement too faint to measure.
/// Source: Loisy and Eloy, Proc. R. Soc. A 478 (2022) 20220118.   Oracle: Infotaxis.*
class Infotaxis : public OceanSearch {
 public:
  explicit Infotaxis(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

  /// What J is expected to be after a measurement at a place (in the domain's frame) under the belief of the last choice.
  [[nodiscard]] double expected_cost(NorthEast place);

 private:
  static constexpr std::size_t kOutcomes = 40;  ///< too faint, and 39 bins of SNR above the floor

  void foresee();
  void tabulate_outcomes();

  double floor_db_;
  std::size_t places_east_;
  std::vector<std::size_t> place_of_;                   ///< [cell]
  std::vector<NorthEast> centres_;                      ///< [place], relative to the area's south-west corner
  std::vector<std::size_t> likely_;                     ///< the hypotheses that count
  std::vector<std::vector<float>> joint_;               ///< [likely][cell], probability of both
  std::vector<std::array<float, kOutcomes>> outcomes_;  ///< [hypothesis x range], probability of each, and of its not being found
  std::vector<float> uncovered_;                        ///< [range], share of a cell there that is not found
  std::vector<float> place_outcomes_;                   ///< [place x outcome]
  std::vector<float> distance_steps_;                   ///< [place]
  std::vector<std::uint16_t> ranges_;                   ///< [cell]
  policy::LaneLikelihoods likelihoods_;
};

}  // namespace earshot::baselines
