#include "policy/ppo/orthogonal.hpp"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

namespace earshot::ppo {

double standard_normal(Pcg32& random) {
  const double radius = std::sqrt(-2.0 * std::log1p(-random.uniform_double()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform_double());
}

Eigen::MatrixXd orthogonal(Eigen::Index outputs, Eigen::Index inputs, double gain, Pcg32& random) {
  const bool wide = outputs < inputs;
  const Eigen::Index tall = wide ? inputs : outputs;
  const Eigen::Index narrow = wide ? outputs : inputs;
  const Eigen::MatrixXd gaussian = Eigen::MatrixXd::NullaryExpr(tall, narrow, [&random] { return standard_normal(random); });
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(gaussian);
  const Eigen::VectorXd signs = qr.matrixQR().diagonal().unaryExpr([](double r) { return r < 0.0 ? -1.0 : 1.0; });
  const Eigen::MatrixXd basis = (qr.householderQ() * Eigen::MatrixXd::Identity(tall, narrow)) * signs.asDiagonal();
  return wide ? Eigen::MatrixXd(gain * basis.transpose()) : Eigen::MatrixXd(gain * basis);
}

}  // namespace earshot::ppo
