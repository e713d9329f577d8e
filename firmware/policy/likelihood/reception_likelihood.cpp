#include "firmware/policy/likelihood/reception_likelihood.hpp"

#include "firmware/policy/normal_table.hpp"

namespace earshot::policy {
namespace {

/// Decibels over which an SNR that follows no model is spread.
constexpr float kOutlierRange_db = 80.0F;

}  // namespace

void to_likelihoods(const ReceptionModel& model, Reception reception, std::span<float> expected_db) {
  const float sounding = 1.0F - model.silence_share;
  const float regular = sounding * (1.0F - model.outlier_share);
  const float per_spread = 1.0F / model.spread_db;
  const float level = static_cast<float>(reception.snr.value) - model.level_offset_db;
  const std::span<float> likelihoods = expected_db;
  for (float& x : likelihoods) x = (level - x) * per_spread;
  if (!reception.too_faint) {
    const float outlier = sounding * model.outlier_share / kOutlierRange_db;
    const float scale = regular * per_spread;
    to_normal_density(likelihoods);
    for (float& likelihood : likelihoods) likelihood = scale * likelihood + outlier;
  } else {
    const float outlier = model.silence_share + sounding * model.outlier_share * 0.5F;
    to_normal_cumulative(likelihoods);
    for (float& likelihood : likelihoods) likelihood = regular * likelihood + outlier;
  }
}

}  // namespace earshot::policy
