#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace earshot::ppo {

/// Adam over one flat array of parameters.
///
///   m <- b1 m + (1 - b1) g,  v <- b2 v + (1 - b2) g^2,  p <- p - lr (m / (1 - b1^t)) / (sqrt(v / (1 - b2^t)) + eps)
///
/// with b1 = 0.9, b2 = 0.999 and eps = 1e-5 (Stable-Baselines3's).
/// Source: Kingma and Ba 2015, arXiv:1412.6980, algorithm 1.   Oracle: Adam.*, Update.*
class Adam {
 public:
  explicit Adam(std::size_t parameter_count) : state_{0, std::vector<float>(parameter_count), std::vector<float>(parameter_count)} {}

  /// What the next step needs of the steps so far.
  struct State {
    std::uint64_t steps = 0;
    std::vector<float> first_moment;   ///< m
    std::vector<float> second_moment;  ///< v
  };
  [[nodiscard]] const State& state() const { return state_; }
  /// @param state  of as many parameters
  void resume(State state);

  /// One step down `gradient`, which has the size of `parameters`.
  void step(std::span<float> parameters, std::span<const float> gradient, double learning_rate);

 private:
  State state_;
};

/// Scales `gradient` so that its 2-norm is at most `max_norm`; returns the norm it had.
///
///   g <- g min(1, max_norm / (|g| + 1e-6))
///
/// Source: torch.nn.utils.clip_grad_norm_.   Oracle: ClipGradient.*
double clip_gradient(std::span<float> gradient, double max_norm);

}  // namespace earshot::ppo
