#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::ppo {

/// Sizes that differ between tasks. Both networks have two hidden layers of kWidth tanh units.
struct NetworkShape {
  Eigen::Index observation_size = 0;
  Eigen::Index action_count = 0;
};

inline constexpr Eigen::Index kWidth = 64;

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Numbers that start on a packet boundary. Elsewhere Eigen would sum the first few apart, in an order that depends on where the heap put
/// them.
template <class Scalar>
using Aligned = std::vector<Scalar, Eigen::aligned_allocator<Scalar>>;

/// The activations that a batch leaves in the networks; one column per sample. Sized once, for batches of up to `capacity` samples.
template <class Scalar>
struct Activations {
  Activations(NetworkShape shape, Eigen::Index capacity)
      : first(2 * kWidth, capacity),
        actor(kWidth, capacity),
        critic(kWidth, capacity),
        logits(shape.action_count, capacity),
        values(1, capacity) {}

  Matrix<Scalar> first;   ///< [2 kWidth x batch] actor's units above the critic's
  Matrix<Scalar> actor;   ///< [kWidth x batch]
  Matrix<Scalar> critic;  ///< [kWidth x batch]
  Matrix<Scalar> logits;  ///< [actions x batch]
  Matrix<Scalar> values;  ///< [1 x batch]
};

/// Separate actor and critic, each observation -> 64 tanh -> 64 tanh -> linear, over one flat array of parameters (for Adam and norm
/// clipping). The first layers of both read the same observation and are one matrix.
template <class Scalar>
class ActorCritic {
 public:
  explicit ActorCritic(NetworkShape shape);

  /// Orthogonal weights (gain sqrt 2 hidden, 0.01 action logits, 1 value), zero biases.
  void initialise(Pcg32& random);

  [[nodiscard]] NetworkShape shape() const { return shape_; }
  [[nodiscard]] std::span<Scalar> parameters() { return parameters_; }
  [[nodiscard]] std::span<const Scalar> parameters() const { return parameters_; }

  /// Runs `batch` samples. @param observations  [observation_size x batch], column-major
  void forward(const Scalar* observations, Eigen::Index batch, Activations<Scalar>& activations) const;

  /// Adds the gradient of a loss with respect to every parameter, by the chain rule from that with respect to logits and values.
  /// @param activations   as forward() left them; hidden layers are overwritten
  /// @param d_logits      [actions x batch] dL/dlogits
  /// @param d_values      [1 x batch] dL/dvalues
  /// @param gradient      of parameters()' size
  /// Oracle: ActorCritic.GradientMatchesFiniteDifferences
  void backward(const Scalar* observations, Eigen::Index batch, Activations<Scalar>& activations, const Matrix<Scalar>& d_logits,
                const Matrix<Scalar>& d_values, std::span<Scalar> gradient);

  /// A layer in the flat array: weights [outputs x inputs] column-major, then biases.
  struct Layer {
    Eigen::Index offset = 0;
    Eigen::Index outputs = 0;
    Eigen::Index inputs = 0;
    [[nodiscard]] Eigen::Index bias() const { return offset + outputs * inputs; }
    [[nodiscard]] Eigen::Index end() const { return bias() + outputs; }
  };
  struct Layout {
    Layer first;  ///< [2 kWidth x observation_size] actor above critic
    Layer actor_second;
    Layer critic_second;
    Layer logits;
    Layer value;
  };
  [[nodiscard]] static Layout layout_of(NetworkShape shape);
  [[nodiscard]] const Layout& layout() const { return layout_; }

 private:
  NetworkShape shape_;
  Layout layout_;
  Aligned<Scalar> parameters_;
  Matrix<Scalar> d_first_;  // [2 kWidth x batch], grown by the first backward()
};

extern template class ActorCritic<float>;
extern template class ActorCritic<double>;

}  // namespace earshot::ppo
