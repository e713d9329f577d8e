#include "firmware/detector/hydrophone/noise_floor.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/detector/hydrophone/chi_square.hpp"

namespace earshot::detector {
namespace {

/// z of a probability near a half: z = sqrt(2 pi) (p - 1/2), within 0.5 % for p from 0.4 to 0.6.
constexpr double kRootTwoPi = 2.5066282746310002;

}  // namespace

void NoiseFloor::configure(std::size_t memory, double degrees_of_freedom) {
  assert(memory > 0 && memory <= ring_.size());
  memory_ = memory;
  degrees_of_freedom_ = degrees_of_freedom;
  size_ = 0;
  oldest_ = 0;
  power_ = 0.0;
}

void NoiseFloor::take(float power) {
  if (size_ == memory_) {
    remove(ring_[oldest_]);
    insert(power);
    ring_[oldest_] = power;
    oldest_ = (oldest_ + 1) % memory_;
  } else {
    ring_[size_] = power;
    insert(power);
  }
  estimate();
}

void NoiseFloor::insert(float power) {
  float* const end = sorted_.data() + size_;
  float* const place = std::upper_bound(sorted_.data(), end, power);
  std::copy_backward(place, end, end + 1);
  *place = power;
  ++size_;
}

void NoiseFloor::remove(float power) {
  float* const end = sorted_.data() + size_;
  float* const place = std::lower_bound(sorted_.data(), end, power);
  std::copy(place + 1, end, place);
  --size_;
}

/// Of n powers the one of rank r = (n + 1) / 2 from below: on average the noise's quantile r / (n + 1).
void NoiseFloor::estimate() {
  const std::size_t rank = (size_ + 1) / 2;
  const double probability = static_cast<double>(rank) / static_cast<double>(size_ + 1);
  const double z = kRootTwoPi * (probability - 0.5);
  power_ = double{sorted_[rank - 1]} / chi_square_over_mean(degrees_of_freedom_, z);
}

}  // namespace earshot::detector
