// Included before the forward pass of a core that takes its hyperbolic tangent from libm.
#pragma once

#include <cmath>
#include <cstring>

template <class Floats>
inline void libm_tanh(Floats& x) {
  float lanes[sizeof(Floats) / sizeof(float)];
  std::memcpy(lanes, &x, sizeof(lanes));
  for (float& lane : lanes) lane = std::tanh(lane);
  std::memcpy(&x, lanes, sizeof(lanes));
}
