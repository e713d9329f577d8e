#include "policy/ppo/actor_critic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "firmware/config/capacities.hpp"
#include "policy/ppo/orthogonal.hpp"
#include "policy/ppo/wide_product.hpp"

namespace earshot::ppo {
namespace {

template <class Scalar>
using Square = Eigen::Matrix<Scalar, kWidth, kWidth>;
template <class Scalar>
using Hidden = Eigen::Matrix<Scalar, kWidth, Eigen::Dynamic>;
template <class Scalar>
using BothHidden = Eigen::Matrix<Scalar, 2 * kWidth, Eigen::Dynamic>;

template <class MatrixType, class Pointer>
auto weights_of(Pointer* flat, const auto& layer) {
  using Mapped = std::conditional_t<std::is_const_v<Pointer>, const MatrixType, MatrixType>;
  return Eigen::Map<Mapped>(flat + layer.offset, layer.outputs, layer.inputs);
}

template <class Scalar, class Pointer>
auto bias_of(Pointer* flat, const auto& layer) {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Mapped = std::conditional_t<std::is_const_v<Pointer>, const Vector, Vector>;
  return Eigen::Map<Mapped>(flat + layer.bias(), layer.outputs);
}

template <class Matrix>
constexpr bool kIsFloat = std::is_same_v<typename std::decay_t<Matrix>::Scalar, float>;

/// A B. In double, which only the test of the gradient uses, by plain loops: Eigen's blocked product for one more type takes seconds to
/// compile.
template <class A, class B>
auto product(const A& a, const B& b) {
  if constexpr (kIsFloat<A>)
    return a * b;
  else
    return a.lazyProduct(b);
}

/// C += A B, C = A B, C += A B^T where A and C have kWidth rows, and C += B A^T where A has: with the wide product where there is one.
template <class C, class A, class B>
void add_product(C&& c, const A& a, const B& b) {
  if constexpr (kIsFloat<C>) {
    if (has_wide_product()) {
      return multiply(
          {a.data(), a.outerStride(), b.data(), 1, b.outerStride(), c.data(), c.outerStride(), a.cols(), b.cols(), WideProduct::Start::kC});
    }
  }
  c.noalias() += product(a, b);
}

template <class C, class A, class B>
void set_product(C&& c, const A& a, const B& b) {
  if constexpr (kIsFloat<C>) {
    if (has_wide_product()) {
      return multiply({a.data(), a.outerStride(), b.data(), 1, b.outerStride(), c.data(), c.outerStride(), a.cols(), b.cols()});
    }
  }
  c.noalias() = product(a, b);
}

template <class C, class A, class B>
void add_product_with_transpose(C&& c, const A& a, const B& b) {
  if constexpr (kIsFloat<C>) {
    if (has_wide_product()) {
      return multiply(
          {a.data(), a.outerStride(), b.data(), b.outerStride(), 1, c.data(), c.outerStride(), a.cols(), b.rows(), WideProduct::Start::kC});
    }
  }
  c.noalias() += product(a, b.transpose());
}

template <class C, class A, class B>
void add_transposed_product(C&& c, const A& a, const B& b) {
  if constexpr (kIsFloat<C>) {
    if (has_wide_product()) {
      Eigen::Matrix<float, kWidth, Eigen::Dynamic, Eigen::ColMajor, kWidth, config::kMaxActions> transposed = c.transpose();
      add_product_with_transpose(transposed, a, b);
      c = transposed.transpose();
      return;
    }
  }
  c.noalias() += product(b, a.transpose());
}

}  // namespace

template <class Scalar>
auto ActorCritic<Scalar>::layout_of(NetworkShape shape) -> Layout {
  Layout layout;
  layout.first = {0, 2 * kWidth, shape.observation_size};
  layout.actor_second = {layout.first.end(), kWidth, kWidth};
  layout.critic_second = {layout.actor_second.end(), kWidth, kWidth};
  layout.logits = {layout.critic_second.end(), shape.action_count, kWidth};
  layout.value = {layout.logits.end(), 1, kWidth};
  return layout;
}

template <class Scalar>
ActorCritic<Scalar>::ActorCritic(NetworkShape shape)
    : shape_(shape), layout_(layout_of(shape)), parameters_(static_cast<std::size_t>(layout_.value.end()), Scalar{0}) {}

template <class Scalar>
void ActorCritic<Scalar>::initialise(Pcg32& random) {
  const double hidden_gain = std::sqrt(2.0);
  std::ranges::fill(parameters_, Scalar{0});
  auto fill = [this, &random](const Layer& layer, double gain) {
    weights_of<Matrix<Scalar>>(parameters_.data(), layer) = orthogonal(layer.outputs, layer.inputs, gain, random).template cast<Scalar>();
  };
  auto first = weights_of<Matrix<Scalar>>(parameters_.data(), layout_.first);
  first.topRows(kWidth) = orthogonal(kWidth, shape_.observation_size, hidden_gain, random).template cast<Scalar>();
  first.bottomRows(kWidth) = orthogonal(kWidth, shape_.observation_size, hidden_gain, random).template cast<Scalar>();
  fill(layout_.actor_second, hidden_gain);
  fill(layout_.critic_second, hidden_gain);
  fill(layout_.logits, 0.01);
  fill(layout_.value, 1.0);
}

template <class Scalar>
void ActorCritic<Scalar>::forward(const Scalar* observations, Eigen::Index batch, Activations<Scalar>& activations) const {
  const Scalar* p = parameters_.data();
  const Eigen::Map<const Matrix<Scalar>> x(observations, shape_.observation_size, batch);
  Eigen::Map<BothHidden<Scalar>> first(activations.first.data(), 2 * kWidth, batch);
  Eigen::Map<Hidden<Scalar>> actor(activations.actor.data(), kWidth, batch);
  Eigen::Map<Hidden<Scalar>> critic(activations.critic.data(), kWidth, batch);

  first.colwise() = bias_of<Scalar>(p, layout_.first);
  add_product(first.template topRows<kWidth>(), weights_of<BothHidden<Scalar>>(p, layout_.first).template topRows<kWidth>(), x);
  add_product(first.template bottomRows<kWidth>(), weights_of<BothHidden<Scalar>>(p, layout_.first).template bottomRows<kWidth>(), x);
  first = first.array().tanh();
  actor.colwise() = bias_of<Scalar>(p, layout_.actor_second);
  add_product(actor, weights_of<Square<Scalar>>(p, layout_.actor_second), first.template topRows<kWidth>());
  actor = actor.array().tanh();
  critic.colwise() = bias_of<Scalar>(p, layout_.critic_second);
  add_product(critic, weights_of<Square<Scalar>>(p, layout_.critic_second), first.template bottomRows<kWidth>());
  critic = critic.array().tanh();
  auto logits = activations.logits.leftCols(batch);
  logits.colwise() = bias_of<Scalar>(p, layout_.logits);
  logits.noalias() += product(weights_of<Matrix<Scalar>>(p, layout_.logits), actor);
  auto values = activations.values.leftCols(batch);
  values.noalias() = product(weights_of<Matrix<Scalar>>(p, layout_.value), critic);
  values.array() += p[layout_.value.bias()];
}

template <class Scalar>
void ActorCritic<Scalar>::backward(const Scalar* observations, Eigen::Index batch, Activations<Scalar>& activations,
                                   const Matrix<Scalar>& d_logits, const Matrix<Scalar>& d_values, std::span<Scalar> gradient) {
  assert(gradient.size() == parameters_.size());
  const Scalar* p = parameters_.data();
  Scalar* g = gradient.data();
  if (d_first_.cols() < batch) d_first_.resize(2 * kWidth, batch);
  const Eigen::Map<const Matrix<Scalar>> x(observations, shape_.observation_size, batch);
  Eigen::Map<BothHidden<Scalar>> first(activations.first.data(), 2 * kWidth, batch);
  Eigen::Map<BothHidden<Scalar>> d_first(d_first_.data(), 2 * kWidth, batch);

  // One branch from its output back to its half of the first layer; `hidden` becomes dL/d(its input before tanh).
  auto branch = [&](const auto& d_output, const Layer& output, const Layer& second, Scalar* hidden_data, const auto& below, auto d_below) {
    Eigen::Map<Hidden<Scalar>> hidden(hidden_data, kWidth, batch);
    add_transposed_product(weights_of<Matrix<Scalar>>(g, output), hidden, d_output);
    bias_of<Scalar>(g, output) += d_output.rowwise().sum();
    const auto slope = (Scalar{1} - hidden.array().square());
    hidden = product(weights_of<Matrix<Scalar>>(p, output).transpose(), d_output).array() * slope;
    add_product_with_transpose(weights_of<Square<Scalar>>(g, second), hidden, below);
    bias_of<Scalar>(g, second) += hidden.rowwise().sum();
    set_product(d_below, Square<Scalar>(weights_of<Square<Scalar>>(p, second).transpose()), hidden);
  };
  branch(d_logits.leftCols(batch), layout_.logits, layout_.actor_second, activations.actor.data(), first.template topRows<kWidth>(),
         d_first.template topRows<kWidth>());
  branch(d_values.leftCols(batch), layout_.value, layout_.critic_second, activations.critic.data(), first.template bottomRows<kWidth>(),
         d_first.template bottomRows<kWidth>());
  d_first.array() *= Scalar{1} - first.array().square();
  auto g_first = weights_of<BothHidden<Scalar>>(g, layout_.first);
  add_product_with_transpose(g_first.template topRows<kWidth>(), d_first.template topRows<kWidth>(), x);
  add_product_with_transpose(g_first.template bottomRows<kWidth>(), d_first.template bottomRows<kWidth>(), x);
  bias_of<Scalar>(g, layout_.first) += d_first.rowwise().sum();
}

template class ActorCritic<float>;
template class ActorCritic<double>;

}  // namespace earshot::ppo
