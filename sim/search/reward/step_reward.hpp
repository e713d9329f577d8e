#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "sim/search/settings.hpp"

namespace earshot::search {

/// Reward of one step that ends at `position`, where `snr` is heard.
///
///   r = (0 if SNR >= DT else -1) + (p (b - d_e) / b if d_e < b)
///
/// @param position  in the domain's frame; d_e, the distance to the nearest edge, is negative outside, where the penalty grows beyond p
/// Source: Clark et al. 2022, reward.   Oracle: StepReward.*
[[nodiscard]] double step_reward(const SearchSettings& settings, NorthEast position, Decibels snr);

/// Whether what was heard is a detection: measured, and SNR >= DT.
[[nodiscard]] bool is_detection(const SearchSettings& settings, policy::Reception reception);
/// As above: what was too faint to measure is no detection, wherever the floor lies.
[[nodiscard]] double step_reward(const SearchSettings& settings, NorthEast position, policy::Reception reception);

}  // namespace earshot::search
