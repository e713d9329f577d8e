#include "policy/ppo/adam.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace earshot::ppo {
namespace {

constexpr double kBeta1 = 0.9;
constexpr double kBeta2 = 0.999;
constexpr double kEpsilon = 1e-5;

auto array_of(std::span<float> x) {
  return Eigen::Map<Eigen::ArrayXf>(x.data(), static_cast<Eigen::Index>(x.size()));
}
auto array_of(std::span<const float> x) {
  return Eigen::Map<const Eigen::ArrayXf>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace

void Adam::resume(State state) {
  assert(state.first_moment.size() == state_.first_moment.size() && state.second_moment.size() == state_.second_moment.size());
  state_ = std::move(state);
}

void Adam::step(std::span<float> parameters, std::span<const float> gradient, double learning_rate) {
  assert(parameters.size() == state_.first_moment.size() && gradient.size() == state_.first_moment.size());
  ++state_.steps;
  const auto t = static_cast<double>(state_.steps);
  const auto step_size = static_cast<float>(learning_rate / (1.0 - std::pow(kBeta1, t)));
  const auto denominator_scale = static_cast<float>(1.0 / std::sqrt(1.0 - std::pow(kBeta2, t)));
  const auto g = array_of(gradient);
  auto m = array_of(std::span(state_.first_moment));
  auto v = array_of(std::span(state_.second_moment));
  m += static_cast<float>(1.0 - kBeta1) * (g - m);
  v = static_cast<float>(kBeta2) * v + static_cast<float>(1.0 - kBeta2) * g.square();
  array_of(parameters) -= step_size * m / (v.sqrt() * denominator_scale + static_cast<float>(kEpsilon));
}

double clip_gradient(std::span<float> gradient, double max_norm) {
  auto g = array_of(gradient);
  const double norm = std::sqrt(static_cast<double>(g.square().sum()));
  g *= static_cast<float>(std::min(1.0, max_norm / (norm + 1e-6)));
  return norm;
}

}  // namespace earshot::ppo
