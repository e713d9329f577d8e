#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::bench {

/// Prints how long `compute` takes for one of a thousand observations, in nanoseconds: the least mean of 300 rounds, for what else the
/// machine does only ever adds.
/// @param compute  float(std::span<const float> observation [size])
template <class Compute>
void print_nanoseconds(std::size_t size, Compute compute) {
  constexpr std::size_t kObservations = 1000;
  Pcg32 random(5);
  std::vector<float> observations(kObservations * size);
  for (float& x : observations) x = 2.0F * random.uniform_float() - 1.0F;
  double best_ns = 1e9;
  volatile float result = 0.0F;  // so that nothing is left out
  for (int round = 0; round < 300; ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < kObservations; ++i) result = compute(std::span<const float>(observations).subspan(i * size, size));
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - began;
    best_ns = std::min(best_ns, spent.count() / static_cast<double>(kObservations));
  }
  static_cast<void>(result);
  std::printf("{\"value\": %.1f}\n", best_ns);
}

}  // namespace earshot::bench
