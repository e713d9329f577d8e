#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace earshot::ppo {

/// C = A B, or C = C + A B, where A and C have 64 rows: the products of two networks of 64 units, without the packing that Eigen's general
/// product needs. All column-major.
struct WideProduct {
  const float* a = nullptr;    ///< [64 x inner]
  Eigen::Index a_stride = 64;  ///< between columns
  const float* b = nullptr;    ///< [inner x columns]
  Eigen::Index b_row_stride = 1;
  Eigen::Index b_column_stride = 64;
  float* c = nullptr;  ///< [64 x columns]
  Eigen::Index c_stride = 64;
  Eigen::Index inner = 64;
  Eigen::Index columns = 0;
  enum class Start : std::uint8_t { kZero, kC } start = Start::kZero;
};

/// Whether this processor has the 512-bit registers (AVX-512F) that it is written for.
[[nodiscard]] bool has_wide_product();

/// To be called only where has_wide_product() says so. Sums over `inner` in order, each fused.
/// Oracle: WideProduct.*   Benchmark: ppo.large_batch.steps_per_s
void multiply(const WideProduct& product);

}  // namespace earshot::ppo
