#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "firmware/core/wide.hpp"

namespace earshot::policy {

int to_log(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const int exponent = static_cast<int>(bits >> 23U) - 127;
  const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U) - 1.0F;
  // A quartic that is at most 8.8e-5 from log2(1 + m) in [0, 1).
  const float log = 8.75882851e-05F + m * (1.43770441F + m * (-0.674942915F + m * (0.318679073F + m * -0.0816157464F)));
  return exponent * kOctave + static_cast<int>(log * static_cast<float>(kOctave) + 0.5F);
}

[[gnu::flatten]] EARSHOT_WIDE void to_logs(std::span<const float> probabilities, std::int16_t least, std::span<std::int16_t> logs) {
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    logs[i] = static_cast<std::int16_t>(std::clamp(to_log(probabilities[i]), int{least}, 0));
}

}  // namespace earshot::policy
