// 64-bit integers as doubles, in place of libgcc's, which computes in software and brings its addition along: 0.9 KB.
//
// The names are the run-time ABI's for Arm (RTABI32, 4.1.2, integer to floating-point conversions), by which the compiler calls them;
// arguments and result go in core registers.
#include <cstdint>

#if __ARM_FP & 8  // the processor computes in double

namespace {

/// The product is exact, so that there is one rounding, to the nearest.
double from_halves(double high, double low) {
  return high * 4294967296.0 + low;
}

}  // namespace

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier): the ABI's
__attribute__((pcs("aapcs"))) double __aeabi_l2d(std::int64_t value) {
  return from_halves(static_cast<double>(static_cast<std::int32_t>(value >> 32)), static_cast<double>(static_cast<std::uint32_t>(value)));
}

__attribute__((pcs("aapcs"))) double __aeabi_ul2d(std::uint64_t value) {
  return from_halves(static_cast<double>(static_cast<std::uint32_t>(value >> 32)), static_cast<double>(static_cast<std::uint32_t>(value)));
}
// NOLINTEND(bugprone-reserved-identifier)

}  // extern "C"

#endif
