#include "sim/spectrum/short_time_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace earshot::spectrum {

struct ShortTimeSpectrum::Engine {
  Eigen::FFT<float> fft;
  std::vector<float> weighted;
  std::vector<std::complex<float>> bins;
};

namespace {

/// What a fast Fourier transform is fast for.
std::size_t largest_smooth_number_up_to(std::size_t most) {
  for (std::size_t length = most; length > 1; --length) {
    std::size_t rest = length;
    for (const std::size_t factor : {2U, 3U, 5U})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
  return 1;
}

}  // namespace

ShortTimeSpectrum::ShortTimeSpectrum(Hertz sample_rate, std::size_t windows_per_length)
    : sample_rate_(sample_rate),
      length_(largest_smooth_number_up_to(static_cast<std::size_t>(std::max(sample_rate.value, 2.0)))),
      hop_((length_ + windows_per_length - 1) / windows_per_length),
      weights_(length_),
      engine_(std::make_unique<Engine>()),
      psd_(bins()) {
  engine_->fft.SetFlag(Eigen::FFT<float>::HalfSpectrum);
  engine_->weighted.resize(length_);
  double energy = 0.0;
  for (std::size_t i = 0; i < length_; ++i) {
    const double weight = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(length_));
    weights_[i] = static_cast<float>(weight);
    energy += weight * weight;
  }
  scale_ = 1.0 / (sample_rate.value * energy);
  window_.reserve(length_);
}

ShortTimeSpectrum::~ShortTimeSpectrum() = default;

void ShortTimeSpectrum::take(std::span<const float> samples, std::uint64_t begin, const Sink& sink) {
  if (begin != window_begin_ + window_.size()) restart();
  while (!samples.empty()) {
    if (window_.empty()) window_begin_ = begin;
    const std::size_t count = std::min(samples.size(), length_ - window_.size());
    window_.insert(window_.end(), samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count));
    samples = samples.subspan(count);
    begin += count;
    if (window_.size() < length_) return;
    transform();
    sink(psd_, window_begin_);
    window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(hop()));
    window_begin_ += hop();
  }
}

void ShortTimeSpectrum::transform() {
  for (std::size_t i = 0; i < length_; ++i) engine_->weighted[i] = weights_[i] * window_[i];
  engine_->fft.fwd(engine_->bins, engine_->weighted);
  for (std::size_t k = 0; k < psd_.size(); ++k) {
    const bool is_single = k == 0 || 2 * k == length_;
    psd_[k] = static_cast<float>((is_single ? 1.0 : 2.0) * scale_ * static_cast<double>(std::norm(engine_->bins[k])));
  }
}

}  // namespace earshot::spectrum
