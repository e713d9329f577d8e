// Peer of the rows network.forward_ns: the same shape in Eigen, sizes known to the compiler, any weights. Built for x86-64-v3
// with fused multiply-add, and for the architecture's baseline.
#include <Eigen/Dense>
#include <memory>

#include "tests/bench/nanoseconds.hpp"

namespace {

constexpr int kObservation = 58;
constexpr int kWidth = 64;
constexpr int kActions = 8;

struct Actor {
  Eigen::Matrix<float, kWidth, kObservation> first = decltype(first)::Random();
  Eigen::Matrix<float, kWidth, kWidth> second = decltype(second)::Random();
  Eigen::Matrix<float, kActions, kWidth> output = decltype(output)::Random();
  Eigen::Matrix<float, kWidth, 1> first_bias = decltype(first_bias)::Random();
  Eigen::Matrix<float, kWidth, 1> second_bias = decltype(second_bias)::Random();
  Eigen::Matrix<float, kActions, 1> output_bias = decltype(output_bias)::Random();
};

}  // namespace

int main() {
  const auto actor = std::make_unique<Actor>();
  return earshot::bench::print_nanoseconds(kObservation, [&](std::span<const float> observation) {
    const Eigen::Map<const Eigen::Matrix<float, kObservation, 1>> seen(observation.data());
    const Eigen::Matrix<float, kWidth, 1> first = (actor->first * seen + actor->first_bias).array().tanh();
    const Eigen::Matrix<float, kWidth, 1> second = (actor->second * first + actor->second_bias).array().tanh();
    const Eigen::Matrix<float, kActions, 1> logits = actor->output * second + actor->output_bias;
    return logits.sum();
  });
}
