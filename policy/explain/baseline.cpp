#include "policy/explain/baseline.hpp"

#include <memory>

namespace earshot::explain {

namespace {

/// A vehicle that has heard nothing has no likeliest place, only the first of many equal ones: the mean stands in for it.
policy::ObservationElement with_mean_for_likeliest(policy::ObservationElement element) {
  if (element.feature == policy::Feature::kLikeliestEast) element.feature = policy::Feature::kMeanEast;
  if (element.feature == policy::Feature::kLikeliestNorth) element.feature = policy::Feature::kMeanNorth;
  return element;
}

}  // namespace

std::vector<float> uninformed_observation(const policy::ObservationModel& model, NorthEast place, Decibels detection_threshold) {
  const auto memory = std::make_unique<policy::SearchMemory>();
  memory->start(model, place, kNothingLearnt);
  std::vector<float> observation(model.spec.size());
  for (std::size_t i = 0; i < observation.size(); ++i) {
    const policy::ObservationElement element = with_mean_for_likeliest(model.spec[i]);
    const double raw = element.feature == policy::Feature::kStepSnr ? detection_threshold.value : memory->raw(model, element);
    observation[i] = static_cast<float>((raw - double{element.offset}) * double{element.scale});
  }
  return observation;
}

}  // namespace earshot::explain
