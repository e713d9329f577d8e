#pragma once

namespace earshot::tests {

/// Whether an emulator runs this test, some twenty times slower than a processor of its own (toolchains/cmake/EarshotTests.cmake).
#ifdef EARSHOT_EMULATED
inline constexpr bool kIsEmulated = true;
#else
inline constexpr bool kIsEmulated = false;
#endif

/// How often a test does the same with other numbers: in an emulator `fewer` times. Every machine computes the same bits (tests/bits), and
/// where tests are compiled for this one all are done.
constexpr int times(int all, int fewer) {
  return kIsEmulated ? fewer : all;
}

}  // namespace earshot::tests
