#include "policy/ppo/wide_product.hpp"

#include <cassert>

namespace earshot::ppo {

#if defined(__x86_64__)
namespace {

constexpr int kLanes = 16;
constexpr int kPackets = 64 / kLanes;
constexpr int kBlock = 6;  // columns at a time: 24 sums, 4 packets of A and broadcasts of B fill the 32 registers

using Packet [[gnu::vector_size(64), gnu::aligned(4), gnu::may_alias]] = float;

template <int kColumns>
[[gnu::target("avx512f")]] void multiply_block(const WideProduct& p, const float* b, float* c) {
  Packet sums[kColumns][kPackets];
#pragma GCC unroll 6
  for (int j = 0; j < kColumns; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kPackets; ++i) {
      sums[j][i] = p.start == WideProduct::Start::kC ? *reinterpret_cast<const Packet*>(c + j * p.c_stride + i * kLanes) : Packet{};
    }
  }
  const float* a = p.a;
  for (Eigen::Index k = 0; k < p.inner; ++k, a += p.a_stride, b += p.b_row_stride) {
    Packet column[kPackets];
#pragma GCC unroll 4
    for (int i = 0; i < kPackets; ++i) column[i] = *reinterpret_cast<const Packet*>(a + i * kLanes);
#pragma GCC unroll 6
    for (int j = 0; j < kColumns; ++j) {
#pragma GCC unroll 4
      for (int i = 0; i < kPackets; ++i) sums[j][i] += column[i] * b[j * p.b_column_stride];
    }
  }
#pragma GCC unroll 6
  for (int j = 0; j < kColumns; ++j) {
#pragma GCC unroll 4
    for (int i = 0; i < kPackets; ++i) *reinterpret_cast<Packet*>(c + j * p.c_stride + i * kLanes) = sums[j][i];
  }
}

}  // namespace

bool has_wide_product() {
  static const bool has = __builtin_cpu_supports("avx512f") != 0;
  return has;
}

void multiply(const WideProduct& p) {
  assert(has_wide_product());
  for (Eigen::Index j = 0; j < p.columns; j += kBlock) {
    const float* b = p.b + j * p.b_column_stride;
    float* c = p.c + j * p.c_stride;
    switch (p.columns - j) {
      case 1:
        multiply_block<1>(p, b, c);
        break;
      case 2:
        multiply_block<2>(p, b, c);
        break;
      case 3:
        multiply_block<3>(p, b, c);
        break;
      case 4:
        multiply_block<4>(p, b, c);
        break;
      case 5:
        multiply_block<5>(p, b, c);
        break;
      default:
        multiply_block<kBlock>(p, b, c);
    }
  }
}

#else

bool has_wide_product() {
  return false;
}
void multiply(const WideProduct&) {
  assert(false && "only where has_wide_product()");
}

#endif

}  // namespace earshot::ppo
