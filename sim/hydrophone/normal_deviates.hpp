#pragma once

#include <cmath>
#include <numbers>

#include "firmware/core/math.hpp"
#include "firmware/core/random.hpp"

namespace earshot::hydrophone {

/// Independent normal numbers of mean 0 and variance 1.
/// Source: Box and Muller, Ann. Math. Statist. 29 (1958) 610.
class NormalDeviates {
 public:
  explicit NormalDeviates(Pcg32 random) : random_(random) {}

  [[nodiscard]] double next() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random_.uniform_double()));
    const SineCosine turned = sine_cosine(Radians{2.0 * std::numbers::pi * random_.uniform_double()});
    second_ = radius * turned.sine;
    has_second_ = true;
    return radius * turned.cosine;
  }

 private:
  Pcg32 random_;
  double second_ = 0.0;
  bool has_second_ = false;
};

}  // namespace earshot::hydrophone
