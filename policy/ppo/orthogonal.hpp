#pragma once

#include <Eigen/Core>

#include "firmware/core/random.hpp"

namespace earshot::ppo {

/// A standard normal number (Box-Muller; takes two uniform numbers).
[[nodiscard]] double standard_normal(Pcg32& random);

/// A random matrix [outputs x inputs] with orthonormal rows or columns (whichever are fewer), times `gain`.
/// Source: Saxe et al. 2014, arXiv:1312.6120; as torch.nn.init.orthogonal_: QR of a Gaussian matrix, columns signed by diag(R).
/// Oracle: Orthogonal.*
[[nodiscard]] Eigen::MatrixXd orthogonal(Eigen::Index outputs, Eigen::Index inputs, double gain, Pcg32& random);

}  // namespace earshot::ppo
