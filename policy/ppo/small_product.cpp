#include "policy/ppo/small_product.hpp"

#include <cassert>
#include <cstring>
#include <utility>

namespace earshot::ppo {
namespace {

template <class Scalar>
struct Simd;
template <>
struct Simd<float> {
  using Pack __attribute__((vector_size(32))) = float;
};
template <>
struct Simd<double> {
  using Pack __attribute__((vector_size(32))) = double;
};

/// `Packs` packs of rows times `Columns` columns of C, held in registers over the whole depth.
template <class Scalar, int Packs, int Columns>
void add_tile(Eigen::Index depth, Panel<const Scalar> a, RightFactor<Scalar> b, Panel<Scalar> c) {
  using Pack = typename Simd<Scalar>::Pack;
  constexpr Eigen::Index kLanes = sizeof(Pack) / sizeof(Scalar);
  Pack sum[Columns][Packs];
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) {
#pragma GCC unroll 8
    for (int r = 0; r < Packs; ++r) std::memcpy(&sum[j][r], c.data + j * c.stride + r * kLanes, sizeof(Pack));
  }
  for (Eigen::Index k = 0; k < depth; ++k) {
    Pack column[Packs];
#pragma GCC unroll 8
    for (int r = 0; r < Packs; ++r) std::memcpy(&column[r], a.data + k * a.stride + r * kLanes, sizeof(Pack));
#pragma GCC unroll 8
    for (int j = 0; j < Columns; ++j) {
      const Scalar factor = b.data[k * b.row_stride + j * b.column_stride];
#pragma GCC unroll 8
      for (int r = 0; r < Packs; ++r) sum[j][r] += column[r] * factor;
    }
  }
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) {
#pragma GCC unroll 8
    for (int r = 0; r < Packs; ++r) std::memcpy(c.data + j * c.stride + r * kLanes, &sum[j][r], sizeof(Pack));
  }
}

/// `Columns` columns of C, tile below tile.
template <class Scalar, int Packs, int Columns>
void add_columns(Eigen::Index rows, Eigen::Index depth, Panel<const Scalar> a, RightFactor<Scalar> b, Panel<Scalar> c) {
  constexpr Eigen::Index kTile = Packs * 32 / static_cast<Eigen::Index>(sizeof(Scalar));
  for (Eigen::Index i = 0; i < rows; i += kTile) add_tile<Scalar, Packs, Columns>(depth, {a.data + i, a.stride}, b, {c.data + i, c.stride});
}

}  // namespace

template <class Scalar>
void add_product(Eigen::Index rows, Eigen::Index columns, Eigen::Index depth, Panel<const Scalar> a, RightFactor<Scalar> b,
                 Panel<Scalar> c) {
  assert(rows % 64 == 0);
  Eigen::Index j = 0;
  auto from_column = [&b, &c, &j] {
    return std::pair{RightFactor<Scalar>{b.data + j * b.column_stride, b.row_stride, b.column_stride},
                     Panel<Scalar>{c.data + j * c.stride, c.stride}};
  };
  for (; j + 4 <= columns; j += 4) {
    const auto [right, out] = from_column();
    add_columns<Scalar, 2, 4>(rows, depth, a, right, out);
  }
  for (; j < columns; ++j) {
    const auto [right, out] = from_column();
    add_columns<Scalar, 8, 1>(rows, depth, a, right, out);
  }
}

template void add_product<float>(Eigen::Index, Eigen::Index, Eigen::Index, Panel<const float>, RightFactor<float>, Panel<float>);
template void add_product<double>(Eigen::Index, Eigen::Index, Eigen::Index, Panel<const double>, RightFactor<double>, Panel<double>);

}  // namespace earshot::ppo
