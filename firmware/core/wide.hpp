#pragma once

// EARSHOT_WIDE before a function: on x86-64 Linux it is compiled twice, for the architecture's baseline and for AVX2, and the wider one
// runs where the processor has AVX2; the choice is made once, when the program is loaded. The core is built without fused multiply-add and
// keeps its order of operations, so that both give the same bits. It pays only for loops over many cells or weights.
#if defined(__x86_64__) && defined(__linux__) && !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)
#define EARSHOT_WIDE __attribute__((target_clones("avx2", "default"), flatten))
#else
#define EARSHOT_WIDE
#endif

namespace earshot {

/// Whether the target has registers that hold several numbers.
#if defined(__SSE2__) || defined(__ARM_NEON)
inline constexpr bool kHasVectors = true;
#else
inline constexpr bool kHasVectors = false;
#endif

}  // namespace earshot
