#pragma once

#include <cmath>
#include <cstdint>

#include "firmware/core/random.hpp"

namespace earshot::support {

/// White Gaussian noise of variance one from the project's generator (Marsaglia's polar method), the same for a seed on every machine with
/// the same libm.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] float operator()() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    for (;;) {
      const float x = 2.0F * random_.uniform_float() - 1.0F;
      const float y = 2.0F * random_.uniform_float() - 1.0F;
      const float square = x * x + y * y;
      if (!(square > 0.0F) || square >= 1.0F) continue;
      const float scale = std::sqrt(-2.0F * std::log(square) / square);
      spare_ = y * scale;
      has_spare_ = true;
      return x * scale;
    }
  }

 private:
  Pcg32 random_;
  float spare_ = 0.0F;
  bool has_spare_ = false;
};

}  // namespace earshot::support
