#include "firmware/policy/action_draw.hpp"

#include <array>
#include <cassert>

#include "firmware/config/capacities.hpp"
#include "firmware/core/math.hpp"

namespace earshot::policy {
namespace {

std::size_t likeliest(std::span<const float> logits) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < logits.size(); ++i) {
    if (logits[i] > logits[best]) best = i;
  }
  return best;
}

}  // namespace

void softmax(std::span<const float> logits, std::span<float> probabilities) {
  assert(!logits.empty() && logits.size() == probabilities.size());
  const float highest = logits[likeliest(logits)];
  float sum = 0.0F;
  for (std::size_t i = 0; i < logits.size(); ++i) {
    probabilities[i] = exp(logits[i] - highest);
    sum += probabilities[i];
  }
  for (float& probability : probabilities) probability /= sum;
}

std::size_t draw_action(ActionDraw draw, std::span<const float> logits, Pcg32& random) {
  assert(!logits.empty() && logits.size() <= config::kMaxActions);
  const std::size_t best = likeliest(logits);
  if (draw == ActionDraw::kArgmax) return best;
  std::array<float, config::kMaxActions> probabilities{};
  softmax(logits, std::span(probabilities).first(logits.size()));
  const float chosen = random.uniform_float();
  float cumulative = 0.0F;
  for (std::size_t i = 0; i < logits.size(); ++i) {
    cumulative += probabilities[i];
    if (chosen < cumulative) return i;
  }
  return best;  // the sum may round to a little less than one
}

}  // namespace earshot::policy
