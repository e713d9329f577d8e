#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/policy/belief/reception.hpp"

namespace earshot::explain {

/// One decision as the vehicle wrote it down.
struct RecordedDecision {
  std::uint32_t step = 0;  ///< 0 for the first action
  double time_s = 0.0;
  NorthEast position;  ///< in the mission's plane
  policy::Reception reception;
  bool detected = false;
  std::size_t action = 0;
  bool overridden = false;  ///< the safety layer changed the way-point
  bool sweeping = false;    ///< the action is a sweep's, not the policy's
  float mismatch_bits = 0.0F;
  bool was_mismatched = false;                            ///< then, or before in this search
  std::optional<float> found_probability = std::nullopt;  ///< where the vehicle declared the source found
  NorthEast waypoint;
  std::vector<float> observation;
  std::vector<float> logits;
};

}  // namespace earshot::explain
