#pragma once

#include <cstddef>

#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// A frequency band, for the noise in it and for sound that is averaged over it.
struct Band {
  Hertz low;              ///< > 0
  Hertz high;             ///< >= low; for noise > low
  std::size_t count = 1;  ///< equal parts in whose middles sound is computed; noise is integrated over the whole band whatever it is
};

}  // namespace earshot::ocean
