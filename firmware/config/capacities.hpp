#pragma once

#include <cstddef>

namespace earshot::config {

// Every size of the fixed-memory core, with its unit, its reason and what happens when it is full.

inline constexpr std::size_t kMaxObservation =
    64;                                         ///< elements of an observation (m = 21 remembered steps of 3); full: policy refused at load
inline constexpr std::size_t kMaxActions = 32;  ///< compass directions (one every 11.25 degrees); full: policy refused at load
inline constexpr std::size_t kMaxLayerWidth =
    64;  ///< units of a hidden layer (Stable-Baselines3's 64-64 default); full: policy refused at load
inline constexpr std::size_t kMaxHiddenLayers = 2;      ///< hidden layers; full: policy refused at load
inline constexpr std::size_t kMaxRememberedSteps = 21;  ///< steps in the memory state; older steps are forgotten
inline constexpr std::size_t kGoldenPairs = 8;          ///< observation -> logits pairs re-checked at boot; exactly this many
inline constexpr std::size_t kMaxProvenance = 1024;     ///< bytes of provenance text in a policy; full: refused at freeze
inline constexpr std::size_t kRuntimeBytes =
    std::size_t{48} * 1024;  ///< bytes of the whole on-vehicle state, nearly all policy weights; full: does not compile

}  // namespace earshot::config
