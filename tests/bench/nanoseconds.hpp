#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"
#include "tests/bench/short_form.hpp"

namespace earshot::bench {

/// Prints how long `compute` takes for one of a thousand observations, in nanoseconds: the least mean of 300 rounds, for what else the
/// machine does only ever adds.
/// @return the program's exit status: 1 where what is computed is not finite, or the same whatever is observed
/// @param compute  float(std::span<const float> observation [size])
template <class Compute>
int print_nanoseconds(std::size_t size, Compute compute) {
  constexpr std::size_t kObservations = 1000;
  Pcg32 random(5);
  std::vector<float> observations(kObservations * size);
  for (float& x : observations) x = 2.0F * random.uniform_float() - 1.0F;
  double best_ns = 1e9;
  volatile float result = 0.0F;  // so that nothing is left out
  const auto compute_for = [&](std::size_t i) { return compute(std::span<const float>(observations).subspan(i * size, size)); };
  const float first = compute_for(0);
  if (!std::isfinite(first) || first == compute_for(1)) {
    std::fprintf(stderr, "what is computed does not depend on what is observed: %g\n", double{first});
    return 1;
  }
  for (int round = 0; round < full_or_short(300, 3); ++round) {
    const auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < kObservations; ++i) result = compute_for(i);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - began;
    best_ns = std::min(best_ns, spent.count() / static_cast<double>(kObservations));
  }
  static_cast<void>(result);
  std::printf("{\"value\": %.1f}\n", best_ns);
  return 0;
}

}  // namespace earshot::bench
