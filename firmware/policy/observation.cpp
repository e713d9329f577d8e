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

void SearchMemory::start(NorthEast position, Decibels snr) {
  position_ = position;
  steps_ = {};
  steps_[0].snr = snr;
}

void SearchMemory::remember(NorthEast position, Decibels snr) {
  std::copy_backward(steps_.begin(), steps_.end() - 1, steps_.end());
  steps_[0] = {.displacement = position - position_, .snr = snr};
  position_ = position;
}

double SearchMemory::raw(const ObservationElement& element) const {
  assert(element.age < steps_.size());
  const Step& step = steps_[element.age];
  switch (element.feature) {
    case Feature::kEast:
      return position_.east.value;
    case Feature::kNorth:
      return position_.north.value;
    case Feature::kStepEast:
      return step.displacement.east.value;
    case Feature::kStepNorth:
      return step.displacement.north.value;
    case Feature::kStepSnr:
      return step.snr.value;
  }
  assert(false && "parse() lets no other feature in");
  return 0.0;
}

void observe(const SearchMemory& memory, const ObservationSpec& spec, std::span<float> observation) {
  assert(observation.size() == spec.size());
  for (std::size_t i = 0; i < spec.size(); ++i) {
    const ObservationElement& element = spec[i];
    observation[i] = static_cast<float>((memory.raw(element) - double{element.offset}) * double{element.scale});
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

}  // namespace earshot::policy
