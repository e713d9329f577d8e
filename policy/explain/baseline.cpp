#include "policy/explain/baseline.hpp"

#include <memory>

namespace earshot::explain {

namespace {

using policy::Feature;

/// A vehicle that has heard nothing has no likeliest place, only the first of many equal ones: the mean stands in for it, and no way leads
/// nearer.
double raw_unheard(const policy::SearchMemory& memory, const policy::ObservationModel& model, policy::ObservationElement element,
                   Decibels detection_threshold) {
  if (element.feature == Feature::kStepSnr) return detection_threshold.value;
  if (element.feature == Feature::kApproach) return 0.0;
  if (element.feature == Feature::kLikeliestEast) element.feature = Feature::kMeanEast;
  if (element.feature == Feature::kLikeliestNorth) element.feature = Feature::kMeanNorth;
  return memory.raw(model, element);
}

}  // namespace

std::vector<float> uninformed_observation(const policy::ObservationModel& model, const policy::OceanTables& tables, NorthEast place,
                                          Decibels detection_threshold) {
  const auto memory = std::make_unique<policy::SearchMemory>();
  memory->start(model, tables, place, kNothingLearnt);
  std::vector<float> observation(model.spec.size());
  for (std::size_t i = 0; i < observation.size(); ++i) {
    observation[i] = policy::scaled(model.spec[i], raw_unheard(*memory, model, model.spec[i], detection_threshold));
  }
  return observation;
}

}  // namespace earshot::explain
