#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// A belief about the source's place in a few numbers.
struct BeliefSummary {
  NorthEast likeliest;  ///< centre of the likeliest cell
  NorthEast mean;
  Meters spread;                 ///< root mean square distance from the mean
  float likeliest_share = 0.0F;  ///< probability of the likeliest cell
  float effective_cells = 0.0F;  ///< one over the sum of squared probabilities: how many cells the belief is spread over
  float mismatch_bits =
      0.0F;  ///< how unlikely what was heard is under all that is believed possible (firmware/policy/ocean_belief/model_mismatch)
};

}  // namespace earshot::messages
