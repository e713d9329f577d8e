#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::explain {

/// One search of a policy, flown without noise, current or navigation error.
struct FlownPath {
  enum class End : std::uint8_t {
    kFound,      ///< within a step length of the source
    kLeft,       ///< outside the policy's area
    kStepLimit,  ///< neither after as many steps as were allowed
  };

  std::vector<NorthEast> places;  ///< the start and the end of every step, relative to the area's south-west corner
  End end = End::kStepLimit;

  [[nodiscard]] std::size_t steps() const { return places.size() - 1; }
};

/// Whether the policy sees nothing but its place: then it does the same there whatever came before, and one measurement shows all of it.
[[nodiscard]] bool sees_place_alone(const policy::FrozenPolicy& policy);

struct PathSettings {
  std::size_t per_side = 6;     ///< starts along a side, the centres of equal cells of the policy's area
  std::size_t max_steps = 100;  ///< N of the paper
};

/// The paths of a policy from starts all over its area, with the memory and the belief that it flies with, the likeliest action at every
/// step.
/// @param reception_at  what is heard at a place
/// @return one path for each start, in the order of an ActionMap
/// Oracle: FlownPaths.*
[[nodiscard]] std::vector<FlownPath> flown_from_all_over(const policy::FrozenPolicy& policy, const policy::OceanTables& tables,
                                                         NorthEast source, const PathSettings& settings,
                                                         const std::function<policy::Reception(NorthEast)>& reception_at);

}  // namespace earshot::explain
