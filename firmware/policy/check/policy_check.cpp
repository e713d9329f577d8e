#include "firmware/policy/check/policy_check.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/policy/belief/search_bounds.hpp"

namespace earshot::policy {
namespace {

// A direction written with 10 digits is a direction; a forgotten normalisation is not.
constexpr double kUnitLengthTolerance = 1e-9;

double absolute(double x) {
  return x < 0.0 ? -x : x;
}

bool is_length(Meters length, double most) {
  return is_within(length.value, kLeastLength_m, most);
}

bool is_unit(const UnitNorthEast& direction) {
  return absolute(direction.north * direction.north + direction.east * direction.east - 1.0) <= kUnitLengthTolerance;
}

bool all_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return is_finite(value); });
}

/// The observation's and the actions' sizes.
bool have_ends_shape(const Network& network) {
  const auto fits = [](std::size_t size, std::size_t capacity) { return size >= 1 && size <= capacity; };
  return fits(network.observation_size, config::kMaxObservation) && fits(network.action_count, config::kMaxActions);
}

PolicyFault fault_in_sizes(const FrozenPolicy& policy) {
  const Network& network = policy.network;
  const bool agree = network.observation_size == policy.observation.spec.size() && network.action_count == policy.actions.size();
  if (!have_ends_shape(network) || !agree) return PolicyFault::kBadShape;
  return has_network(network) ? fault_in_shape(network) : PolicyFault::kNone;
}

/// The most that a layer can give when no input is greater than `most_input`, either side of zero.
double most_output(const Network::ConstLayer& layer, double most_input) {
  double most = 0.0;
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    double sum = absolute(double{layer.bias[o]});
    for (std::size_t i = 0; i < layer.inputs; ++i) sum += absolute(double{layer.weight(o, i)}) * most_input;
    most = std::max(most, sum);
  }
  return most;
}

bool is_finite_layer(const Network::ConstLayer& layer) {
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    for (std::size_t i = 0; i < layer.inputs; ++i) {
      if (!is_finite(layer.weight(o, i))) return false;
    }
  }
  return all_finite(layer.bias.first(layer.outputs));
}

/// Whether the observation shows every action's preference, once and on one scale.
bool shows_advice(const FrozenPolicy& policy) {
  const ObservationSpec& spec = policy.observation.spec;
  const auto is_preference = [](const ObservationElement& element) { return element.feature == Feature::kPreference; };
  const ObservationElement* const first = std::find_if(spec.begin(), spec.end(), is_preference);
  if (first == spec.end() || !(first->scale > 0.0F)) return false;
  for (std::size_t a = 0; a < policy.actions.size(); ++a) {
    const ObservationElement shown{
        .feature = Feature::kPreference, .age = static_cast<std::uint8_t>(a), .offset = first->offset, .scale = first->scale};
    if (std::count(spec.begin(), spec.end(), shown) != 1) return false;
  }
  return std::count_if(spec.begin(), spec.end(), is_preference) == static_cast<std::ptrdiff_t>(policy.actions.size());
}

PolicyFault fault_in_network(const Network& network, double most_element) {
  const std::size_t last = network.hidden_count();
  for (std::size_t l = 0; l <= last; ++l)
    if (!is_finite_layer(network.layer(l))) return PolicyFault::kNotFinite;
  double most = most_element;
  for (std::size_t l = 0; l <= last; ++l) {
    const double most_sum = most_output(network.layer(l), most);
    if (!(most_sum <= kMostLogit)) return PolicyFault::kUnbounded;
    most = network.activation == Activation::kTanh ? 1.0 : most_sum;
  }
  return PolicyFault::kNone;
}

/// How many `age`s a feature of this policy may have.
std::size_t count_of(Feature feature, const FrozenPolicy& policy) {
  if (feature >= Feature::kStepEast && feature <= Feature::kStepSnr) return config::kMaxRememberedSteps;
  if (feature >= Feature::kFound) return policy.actions.size();
  return 1;
}

/// No raw value of the feature is greater than that, either side of zero, while the vehicle is in its area.
double most_raw(Feature feature, const FrozenPolicy& policy) {
  const BeliefModel& belief = policy.observation.belief;
  switch (feature) {
    case Feature::kStepSnr:
      return kMostLevel_db;
    case Feature::kEffectiveCells:
      return 2.0 * static_cast<double>(config::kMaxBeliefCells);
    case Feature::kLikeliestShare:
    case Feature::kFound:
    case Feature::kFindProbability:
    case Feature::kDetected:
    case Feature::kPreference:
      return 2.0;  // a probability, rounded
    case Feature::kBorder:
      return 1.0 + policy.step_length / belief.border_width;
    case Feature::kRegret:
      return double{belief.costs.most_regret};
    case Feature::kEast:
    case Feature::kNorth:
    case Feature::kStepEast:
    case Feature::kStepNorth:
    case Feature::kToSouthEdge:
    case Feature::kToNorthEdge:
    case Feature::kToWestEdge:
    case Feature::kToEastEdge:
    case Feature::kLikeliestEast:
    case Feature::kLikeliestNorth:
    case Feature::kMeanEast:
    case Feature::kMeanNorth:
    case Feature::kSpread:
    case Feature::kApproach:
      break;  // a length
  }
  return (2.0 * (policy.area_size.north + policy.area_size.east) + policy.step_length).value;
}

double most_element(const FrozenPolicy& policy) {
  double most = 0.0;
  for (const ObservationElement& e : policy.observation.spec)
    most = std::max(most, (most_raw(e.feature, policy) + absolute(double{e.offset})) * absolute(double{e.scale}));
  return most;
}

PolicyFault fault_in_observation(const FrozenPolicy& policy) {
  if (!is_length(policy.area_size.north, kMostArea_m) || !is_length(policy.area_size.east, kMostArea_m)) return PolicyFault::kOutOfRange;
  if (!is_within(policy.detection_threshold.value, -kMostLevel_db, kMostLevel_db)) return PolicyFault::kOutOfRange;
  if (!config::is_valid(policy.observation.listening)) return PolicyFault::kUnknownListening;
  for (const ObservationElement& element : policy.observation.spec) {
    if (!is_known(element.feature)) return PolicyFault::kUnknownFeature;
    if (element.age >= count_of(element.feature, policy)) return PolicyFault::kBadShape;
    if (!is_finite(element.offset) || !is_finite(element.scale)) return PolicyFault::kNotFinite;
  }
  if (needs_area(policy.observation.spec) && policy.observation.belief.area_size != policy.area_size) return PolicyFault::kBadShape;
  return PolicyFault::kNone;
}

PolicyFault fault_in_actions(const FrozenPolicy& policy) {
  if (!is_length(policy.step_length, kMostStep_m)) return PolicyFault::kOutOfRange;
  const bool are_units =
      std::all_of(policy.actions.begin(), policy.actions.end(), [](const UnitNorthEast& action) { return is_unit(action); });
  return are_units ? PolicyFault::kNone : PolicyFault::kNotFinite;
}

PolicyFault fault_in_draw(ActionDraw draw) {
  return draw == ActionDraw::kArgmax || draw == ActionDraw::kSampled ? PolicyFault::kNone : PolicyFault::kUnknownDraw;
}

/// Whether the belief is about the search that the policy is for.
bool agrees(const BeliefModel& model, const FrozenPolicy& policy) {
  return model.area_size == policy.area_size && model.step_length == policy.step_length &&
         model.detection_threshold == policy.detection_threshold &&
         std::equal(model.actions.begin(), model.actions.end(), policy.actions.begin(), policy.actions.end());
}

PolicyFault fault_in_belief(const FrozenPolicy& policy) {
  const BeliefModel& model = policy.observation.belief;
  if (!needs_belief(policy.observation.spec)) return PolicyFault::kNone;
  if (!has_valid_shape(model) || !agrees(model, policy)) return PolicyFault::kBadShape;
  return has_valid_numbers(model) ? PolicyFault::kNone : PolicyFault::kOutOfRange;
}

/// Places and sounds alone; a vehicle makes the rest itself.
PolicyFault fault_in_golden(const FrozenPolicy& policy) {
  const auto is_possible = [&policy](const GoldenStep& step) {
    return is_within(step.place.north.value, 0.0, policy.area_size.north.value) &&
           is_within(step.place.east.value, 0.0, policy.area_size.east.value) &&
           is_within(step.reception.snr.value, -kMostLevel_db, kMostLevel_db);
  };
  for (const GoldenTrajectory& trajectory : policy.golden)
    if (!std::all_of(trajectory.begin(), trajectory.end(), is_possible)) return PolicyFault::kOutOfRange;
  return PolicyFault::kNone;
}

}  // namespace

PolicyFault fault_in_shape(const Network& network) {
  if (network.activation != Activation::kTanh && network.activation != Activation::kRelu) return PolicyFault::kUnknownActivation;
  if (!have_ends_shape(network) || !has_shape(network)) return PolicyFault::kBadShape;
  return fits(network) ? PolicyFault::kNone : PolicyFault::kTooLarge;
}

PolicyComplaint with_size(PolicyComplaint complaint, const Network& network) {
  if (complaint.fault == PolicyFault::kTooLarge) complaint.size = bytes_of_numbers(network);
  return complaint;
}

PolicyComplaint check(const FrozenPolicy& policy) {
  const auto complaint = [](PolicyFault fault, SectionTag section) { return PolicyComplaint{.fault = fault, .section = section}; };
  if (const PolicyFault fault = fault_in_sizes(policy); fault != PolicyFault::kNone)
    return with_size(complaint(fault, kNetworkSection), policy.network);
  if (const PolicyFault fault = fault_in_observation(policy); fault != PolicyFault::kNone) return complaint(fault, kObservationSection);
  if (const PolicyFault fault = fault_in_actions(policy); fault != PolicyFault::kNone) return complaint(fault, kActionsSection);
  if (const PolicyFault fault = fault_in_draw(policy.draw); fault != PolicyFault::kNone) return complaint(fault, kDrawSection);
  if (const PolicyFault fault = fault_in_belief(policy); fault != PolicyFault::kNone) return complaint(fault, kBeliefSection);
  if (const PolicyFault fault = fault_in_golden(policy); fault != PolicyFault::kNone) return complaint(fault, kGoldenSection);
  const double most = most_element(policy);
  if (!(most <= kMostElement)) return complaint(PolicyFault::kUnbounded, kObservationSection);
  if (!has_network(policy.network))
    return shows_advice(policy) ? PolicyComplaint{} : complaint(PolicyFault::kNoAdvice, kObservationSection);
  if (const PolicyFault fault = fault_in_network(policy.network, most); fault != PolicyFault::kNone)
    return complaint(fault, kNetworkSection);
  return {};
}

}  // namespace earshot::policy
