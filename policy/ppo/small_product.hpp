#pragma once

#include <Eigen/Core>

namespace earshot::ppo {

/// Element (k, j) of the right factor stands at data[k * row_stride + j * column_stride]: either way of storing it will do.
template <class Scalar>
struct RightFactor {
  const Scalar* data;
  Eigen::Index row_stride;
  Eigen::Index column_stride;
};

/// Column-major with `stride` between columns.
template <class Scalar>
struct Panel {
  Scalar* data;
  Eigen::Index stride;
};

/// C += A B for the products of a minibatch: C [rows x columns], A [rows x depth], rows a multiple of 64.
/// Everything fits the first-level cache, so nothing is packed or blocked, which is most of what a general product spends on this size.
/// Measured on ppo.steps_per_s: README.md. Oracle: SmallProduct.*
template <class Scalar>
void add_product(Eigen::Index rows, Eigen::Index columns, Eigen::Index depth, Panel<const Scalar> a, RightFactor<Scalar> b,
                 Panel<Scalar> c);

}  // namespace earshot::ppo
