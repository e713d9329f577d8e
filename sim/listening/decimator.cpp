#include "sim/listening/decimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::listening {
namespace {

/// Kaiser's: side lobes of 100 dB.
constexpr double kBeta = 10.06;
/// The middle of the edge, which reaches from 0.4 to 0.6.
constexpr double kEdgeOverLowerRate = 0.5;

}  // namespace

std::size_t decimation_for(Hertz sample_rate) {
  const auto least = static_cast<std::size_t>(std::ceil(sample_rate / messages::kHighestSampleRate));
  if (least <= 1) return 1;
  for (std::size_t factor = least; factor < 2 * least; ++factor)
    if (std::fmod(sample_rate.value, static_cast<double>(factor)) == 0.0) return factor;
  return least;
}

Decimator::Decimator(std::size_t factor, float full_scale) : factor_(factor), full_scale_(full_scale), taps_(2 * kReach * factor + 1) {
  const auto reach = static_cast<double>(kReach * factor);
  double sum = 0.0;
  std::vector<double> taps;
  for (std::size_t k = 0; k < taps_.size(); ++k) {
    const double from_middle = static_cast<double>(k) - reach;
    const double angle = 2.0 * std::numbers::pi * kEdgeOverLowerRate * from_middle / static_cast<double>(factor);
    const double share = from_middle / reach;
    const double window = std::cyl_bessel_i(0.0, kBeta * std::sqrt(std::max(1.0 - share * share, 0.0)));
    taps.push_back(window * (angle == 0.0 ? 1.0 : std::sin(angle) / angle));
    sum += taps.back();
  }
  std::ranges::transform(taps, taps_.begin(), [sum](double tap) { return static_cast<float>(tap / sum); });
}

std::span<const float> Decimator::take(std::span<const float> samples) {
  lower_.clear();
  if (samples.empty()) return lower_;
  if (window_.empty()) window_.assign(taps_.size() - 1, samples.front());
  window_.insert(window_.end(), samples.begin(), samples.end());
  const float loudest = std::nextafter(full_scale_, 0.0F);
  const auto is_clipped = [this](float x) { return std::abs(x) >= full_scale_; };
  std::size_t begin = 0;
  for (; begin + taps_.size() - 1 + factor_ <= window_.size(); begin += factor_) {
    float sum = 0.0F;
    for (std::size_t k = 0; k < taps_.size(); ++k) sum += taps_[k] * window_[begin + k];
    const auto middle = std::span(window_).subspan(begin + kReach * factor_, factor_);
    const auto clipped = std::ranges::find_if(middle, is_clipped);
    lower_.push_back(clipped != middle.end() ? std::copysign(1.0F, *clipped) : std::clamp(sum, -loudest, loudest));
  }
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(begin));
  return lower_;
}

}  // namespace earshot::listening
