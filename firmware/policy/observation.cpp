#include "firmware/policy/observation.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/core/math.hpp"

namespace earshot::policy {
namespace {

constexpr double kSnrUnit = 30.0;  ///< dB that one unit of a scaled SNR stands for: the paper's SNR spans about +-30 dB about its threshold

ObservationElement centred(Feature feature, Meters length) {
  return {.feature = feature, .age = 0, .offset = static_cast<float>(length.value / 2.0), .scale = static_cast<float>(2.0 / length.value)};
}

template <std::size_t N>
ObservationSpec spec_of(const std::array<ObservationElement, N>& elements) {
  ObservationSpec spec;
  for (const ObservationElement& element : elements) {
    [[maybe_unused]] const Status status = spec.push_back(element);
    assert(status == Status::kOk);
  }
  return spec;
}

}  // namespace

float scaled(const ObservationElement& element, double raw) {
  return static_cast<float>((raw - double{element.offset}) * double{element.scale});
}

bool is_known(Feature feature) {
  const auto within = [feature](Feature first, Feature last) { return feature >= first && feature <= last; };
  return within(Feature::kEast, Feature::kToEastEdge) || needs_belief(feature);
}

bool needs_belief(Feature feature) {
  const auto within = [feature](Feature first, Feature last) { return feature >= first && feature <= last; };
  return within(Feature::kLikeliestEast, Feature::kEffectiveCells) || within(Feature::kFound, Feature::kApproach);
}

bool needs_belief(const ObservationSpec& spec) {
  return std::any_of(spec.begin(), spec.end(), [](const ObservationElement& element) { return needs_belief(element.feature); });
}

bool needs_area(const ObservationSpec& spec) {
  return std::any_of(spec.begin(), spec.end(), [](const ObservationElement& element) {
    return element.feature == Feature::kToNorthEdge || element.feature == Feature::kToEastEdge;
  });
}

void SearchMemory::start(const ObservationModel& model, const OceanTables& tables, NorthEast position, Reception reception) {
  position_ = position;
  steps_ = {};
  steps_[0].snr = reception.snr;
  if (!needs_belief(model.spec)) return;
  belief_.start(model.belief, tables);
  belief_.update(model.belief, tables, position, reception);
}

void SearchMemory::remember(const ObservationModel& model, const OceanTables& tables, NorthEast position, Reception reception) {
  std::copy_backward(steps_.begin(), steps_.end() - 1, steps_.end());
  steps_[0] = {.displacement = position - position_, .snr = reception.snr};
  position_ = position;
  if (needs_belief(model.spec)) belief_.update(model.belief, tables, position, reception);
}

bool SearchMemory::refine(const ObservationModel& model, const OceanTables& tables) {
  return needs_belief(model.spec) && belief_.refine(model.belief, tables);
}

double SearchMemory::raw(const ObservationModel& model, const ObservationElement& element) const {
  switch (element.feature) {
    case Feature::kEast:
    case Feature::kToWestEdge:
      return position_.east.value;
    case Feature::kNorth:
    case Feature::kToSouthEdge:
      return position_.north.value;
    case Feature::kToNorthEdge:
      return (model.belief.area_size.north - position_.north).value;
    case Feature::kToEastEdge:
      return (model.belief.area_size.east - position_.east).value;
    case Feature::kStepEast:
      return steps_[element.age].displacement.east.value;
    case Feature::kStepNorth:
      return steps_[element.age].displacement.north.value;
    case Feature::kStepSnr:
      return steps_[element.age].snr.value;
    default:
      return of_belief(model.belief, element);
  }
}

double SearchMemory::of_belief(const BeliefModel& model, const ObservationElement& element) const {
  const messages::BeliefSummary& summary = belief_.summary();
  const ActionValues& values = belief_.action_values(element.age);
  switch (element.feature) {
    case Feature::kLikeliestEast:
      return (summary.likeliest - position_).east.value;
    case Feature::kLikeliestNorth:
      return (summary.likeliest - position_).north.value;
    case Feature::kMeanEast:
      return (summary.mean - position_).east.value;
    case Feature::kMeanNorth:
      return (summary.mean - position_).north.value;
    case Feature::kSpread:
      return summary.spread.value;
    case Feature::kLikeliestShare:
      return double{summary.likeliest_share};
    case Feature::kEffectiveCells:
      return double{summary.effective_cells};
    case Feature::kFound:
      return double{values.found};
    case Feature::kDetected:
      return double{values.detected};
    case Feature::kFindProbability:
      return double{values.find_probability};
    case Feature::kBorder:
      return double{values.border};
    case Feature::kRegret:
      return double{values.regret};
    case Feature::kPreference:
      return 1.0 / (1.0 + double{values.regret});
    case Feature::kApproach:
      return (range_between(position_, summary.likeliest) -
              range_between(position_ + model.step_length * model.actions[element.age], summary.likeliest))
          .value;
    default:
      break;
  }
  assert(false && "parse() lets no other feature in");
  return 0.0;
}

void observe(const SearchMemory& memory, const ObservationModel& model, std::span<float> observation) {
  assert(observation.size() == model.spec.size());
  for (std::size_t i = 0; i < model.spec.size(); ++i) {
    observation[i] = scaled(model.spec[i], memory.raw(model, model.spec[i]));
  }
}

ObservationSpec simple_state(NorthEast area_size) {
  return spec_of(std::array{centred(Feature::kEast, area_size.east), centred(Feature::kNorth, area_size.north)});
}

Result<ObservationSpec> memory_state(std::size_t steps, Meters step_length, Decibels detection_threshold) {
  static_assert(3 * config::kMaxRememberedSteps <= config::kMaxObservation);
  const bool usable = steps >= 1 && steps <= config::kMaxRememberedSteps && step_length.value > 0.0 && is_finite(step_length.value) &&
                      is_finite(detection_threshold.value);
  if (!usable) return Status::kOutOfRange;
  ObservationSpec spec;
  const auto per_step = static_cast<float>(1.0 / step_length.value);
  for (std::size_t i = 0; i < steps; ++i) {
    const auto age = static_cast<std::uint8_t>(i);
    const std::array elements = {
        ObservationElement{.feature = Feature::kStepEast, .age = age, .offset = 0.0F, .scale = per_step},
        ObservationElement{.feature = Feature::kStepNorth, .age = age, .offset = 0.0F, .scale = per_step},
        ObservationElement{.feature = Feature::kStepSnr,
                           .age = age,
                           .offset = static_cast<float>(detection_threshold.value),
                           .scale = static_cast<float>(1.0 / kSnrUnit)},
    };
    for (const ObservationElement& element : elements) {
      if (const Status status = spec.push_back(element); status != Status::kOk) return status;
    }
  }
  return spec;
}

ObservationSpec belief_state(const BeliefModel& model) {
  ObservationSpec spec;
  const auto add = [&spec](Feature feature, std::size_t index, double offset, double scale) {
    [[maybe_unused]] const Status status = spec.push_back({.feature = feature,
                                                           .age = static_cast<std::uint8_t>(index),
                                                           .offset = static_cast<float>(offset),
                                                           .scale = static_cast<float>(scale)});
    assert(status == Status::kOk);
  };
  const double half_north = 0.5 * model.area_size.north.value;
  const double half_east = 0.5 * model.area_size.east.value;
  for (const Feature edge : {Feature::kToSouthEdge, Feature::kToNorthEdge}) add(edge, 0, half_north, 1.0 / half_north);
  for (const Feature edge : {Feature::kToWestEdge, Feature::kToEastEdge}) add(edge, 0, half_east, 1.0 / half_east);
  for (const Feature place : {Feature::kLikeliestEast, Feature::kMeanEast}) add(place, 0, 0.0, 1.0 / half_east);
  for (const Feature place : {Feature::kLikeliestNorth, Feature::kMeanNorth}) add(place, 0, 0.0, 1.0 / half_north);
  add(Feature::kSpread, 0, 0.0, 1.0 / half_north);
  add(Feature::kLikeliestShare, 0, 0.0, 1.0);
  const double per_step = 1.0 / model.step_length.value;
  // As many features of each action as there is room for, those that matter most first.
  for (const Feature feature :
       {Feature::kPreference, Feature::kFindProbability, Feature::kBorder, Feature::kDetected, Feature::kFound, Feature::kApproach}) {
    if (spec.size() + model.actions.size() > spec.capacity()) break;
    for (std::size_t a = 0; a < model.actions.size(); ++a) add(feature, a, 0.0, feature == Feature::kApproach ? per_step : 1.0);
  }
  return spec;
}

}  // namespace earshot::policy
