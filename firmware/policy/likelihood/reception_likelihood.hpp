#pragma once

#include <span>

#include "firmware/policy/belief/reception.hpp"

namespace earshot::policy {

/// How what is received departs from what is expected.
struct ReceptionModel {
  float level_offset_db;  ///< the source is that much louder than expected
  float spread_db;        ///< standard deviation of what is measured, > 0
  float silence_share;    ///< of the measurements that meet a pause in the call, 0 to 1
  float outlier_share;    ///< of the SNRs that follow no model, 0 to 1
};

/// Puts the likelihood of what was received in the place of every SNR expected (dB). With q = silence_share and o = outlier_share:
///
///   measured   (1 - q) [(1 - o) N(SNR; expected + offset, spread) + o / 80 dB]
///   too faint  q + (1 - q) [(1 - o) P(below the floor) + o / 2]
///
/// Oracle: LaneLikelihoodsTest.*, ReceptionLikelihood.*
void to_likelihoods(const ReceptionModel& model, Reception reception, std::span<float> expected_db);

}  // namespace earshot::policy
