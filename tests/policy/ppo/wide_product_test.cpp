#include "policy/ppo/wide_product.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::ppo {
namespace {

/// Small whole numbers: every sum is exact in a float, whatever its order.
float number(Eigen::Index i) {
  return static_cast<float>((i * 7919) % 17 - 8);
}

class WideProductTest : public testing::TestWithParam<Eigen::Index> {};

TEST_P(WideProductTest, IsTheSumOverRowsTimesColumnsAtEveryStride) {
  if (!has_wide_product()) GTEST_SKIP() << "no AVX-512 here";
  constexpr Eigen::Index kInner = 13;
  constexpr Eigen::Index kStride = 70;
  const Eigen::Index columns = GetParam();
  std::vector<float> a(kInner * kStride);
  std::vector<float> b(static_cast<std::size_t>(40 * kInner * columns));
  std::vector<float> c(static_cast<std::size_t>(kStride * columns), 3.0F);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = number(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = number(static_cast<Eigen::Index>(3 * i + 1));
  for (const bool adds : {false, true}) {
    const std::vector<float> before = c;
    multiply({.a = a.data(),
              .a_stride = kStride,
              .b = b.data(),
              .b_row_stride = columns,
              .b_column_stride = 1,
              .c = c.data(),
              .c_stride = kStride,
              .inner = kInner,
              .columns = columns,
              .start = adds ? WideProduct::Start::kC : WideProduct::Start::kZero});
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index i = 0; i < kStride; ++i) {
        const auto at = static_cast<std::size_t>(j * kStride + i);
        float expected = adds || i >= 64 ? before[at] : 0.0F;
        for (Eigen::Index k = 0; k < kInner && i < 64; ++k) {
          expected += a[static_cast<std::size_t>(k * kStride + i)] * b[static_cast<std::size_t>(k * columns + j)];
        }
        ASSERT_EQ(c[at], expected) << i << ' ' << j << " rows from 64 on are not its own";
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryRemainder, WideProductTest, testing::Range<Eigen::Index>(1, 20));

}  // namespace
}  // namespace earshot::ppo
