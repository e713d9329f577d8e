#pragma once

#include <cstdint>

namespace earshot {

/// PCG32 (XSH-RR 64/32): a small generator with the same bits on every machine, for drawing actions and for simulation.
/// Source: O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number Generation",
/// HMC-CS-2014-0905. Oracle: Pcg32.GivesThePublishedSequenceOfSeed42Stream54
class Pcg32 {
 public:
  constexpr explicit Pcg32(std::uint64_t seed, std::uint64_t stream = 0) : state_(0), increment_((stream << 1U) | 1U) {
    next();
    state_ += seed;
    next();
  }

  /// All that decides the numbers still to come.
  struct State {
    std::uint64_t state;
    std::uint64_t increment;  ///< odd
    friend constexpr bool operator==(const State&, const State&) = default;
  };
  [[nodiscard]] constexpr State state() const { return {state_, increment_}; }
  /// The generator whose state() this was.
  constexpr explicit Pcg32(const State& state) : state_(state.state), increment_(state.increment) {}

  constexpr std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto xorshifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<std::uint32_t>(old >> 59U);
    return (xorshifted >> rotation) | (xorshifted << ((32U - rotation) & 31U));
  }

  /// Uniform in [0, 1): 24 random bits, exact in a float.
  constexpr float uniform_float() { return static_cast<float>(next() >> 8U) * 0x1.0p-24F; }

  /// Uniform in [0, 1): 53 random bits, exact in a double.
  constexpr double uniform_double() {
    const std::uint64_t high = next() >> 5U;
    const std::uint64_t low = next() >> 6U;
    return static_cast<double>((high << 26U) | low) * 0x1.0p-53;
  }

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace earshot
