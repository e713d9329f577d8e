#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/random.hpp"

namespace earshot::policy {

/// How a policy turns logits into an action.
enum class ActionDraw : std::uint8_t {
  kArgmax = 1,   ///< the likeliest action; the first of equals
  kSampled = 2,  ///< drawn from the softmax of the logits
};

/// Index of the drawn action. kSampled takes one number from `random`; kArgmax takes none.
[[nodiscard]] std::size_t draw_action(ActionDraw draw, std::span<const float> logits, Pcg32& random);

/// Softmax of the logits: probabilities[i] = exp(logit_i - max) / sum, bit-exact (core/math exp).
void softmax(std::span<const float> logits, std::span<float> probabilities);

}  // namespace earshot::policy
