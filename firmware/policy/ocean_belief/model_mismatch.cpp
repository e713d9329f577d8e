#include "firmware/policy/ocean_belief/model_mismatch.hpp"

#include <algorithm>

#include "firmware/policy/likelihood/reception_likelihood.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

// Chosen in 100 searches of each of 24 worlds (README.md): without them the belief explains limestone as a source 9 dB louder that
// swims beside the vehicle.
constexpr std::array<int, kLevelOffsets_db.size()> kPriorPenaltyOfLevel{0, 0, 0, 0, 2 * kOctave, 6 * kOctave, 12 * kOctave};
constexpr std::array<int, kSpreads_db.size()> kPriorPenaltyOfSpread{0, 0, 0, 4 * kOctave};
constexpr int kPriorPenaltyOfMotion = 4 * kOctave;

constexpr float kLevelStep_db = 5.0F;  // between two levels of P0, the first 0
constexpr std::array<float, 2> kP0Spreads_db{2.0F, 5.0F};
constexpr float kOutlierShare = 0.02F;
constexpr float kFaintShare = 0.05F;
/// A part of P0 that was unlikely can come back; and no product of measurements gets too small for a float.
constexpr float kLeastWeight = 1e-6F;
/// A summand so many powers of two below the highest adds nothing.
constexpr int kMostBelow = 60 * kOctave;

}  // namespace

int prior_penalty(const Hypothesis& h) {
  return kPriorPenaltyOfLevel[h.level] + kPriorPenaltyOfSpread[h.spread] +
         (h.mobility > 0 || !h.drift.is_none() ? kPriorPenaltyOfMotion : 0);
}

int log_of_sum(std::span<const int> logs) {
  const int highest = *std::max_element(logs.begin(), logs.end());
  float sum = 0.0F;
  for (const int log : logs) sum += from_log(std::max(log - highest, -kMostBelow));
  return highest + to_log(sum);
}

void ModelMismatch::start() {
  for (auto& weights : weights_) weights.fill(1.0F / static_cast<float>(kLevels * kSpreads));
  known_nothing_ = 0;
  bearings_ = 0;
  bits_ = 0.0F;
  is_mismatched_ = false;
  calls_for_sweep_ = false;
}

void ModelMismatch::take_in(const Reception& reception, int explained) {
  hear(reception);
  bits_ = static_cast<float>(known_nothing_ - explained - bearings_) * (1.0F / static_cast<float>(kOctave));
  is_mismatched_ = is_mismatched_ || bits_ >= kMismatchLevel_bits;
  calls_for_sweep_ = calls_for_sweep_ || bits_ >= kSweepLevel_bits;
}

void ModelMismatch::hear(const Reception& reception) {
  if (reception.too_faint) {
    known_nothing_ += tempered(to_log(kFaintShare));
    return;
  }
  float sum = 0.0F;
  for (std::size_t s = 0; s < kSpreads; ++s) {
    std::array<float, kLevels> likelihoods;
    for (std::size_t l = 0; l < kLevels; ++l) likelihoods[l] = kLevelStep_db * static_cast<float>(l);
    to_likelihoods({.level_offset_db = 0.0F, .spread_db = kP0Spreads_db[s], .silence_share = 0.0F, .outlier_share = kOutlierShare},
                   reception, likelihoods);
    for (std::size_t l = 0; l < kLevels; ++l) sum += weights_[s][l] *= from_log(tempered(to_log(likelihoods[l])));
  }
  known_nothing_ += tempered(to_log(1.0F - kFaintShare)) + to_log(sum);
  for (auto& weights : weights_) {
    for (float& weight : weights) weight = std::max(weight / sum, kLeastWeight);
  }
}

}  // namespace earshot::policy
