#include "sim/listening/channel_detectors.hpp"

#include <cmath>
#include <utility>

namespace earshot::listening {
namespace {

using recording::Piece;
using recording::Sequence;

/// Thresholds of a curve, dB.
constexpr int kLowestThreshold_db = 0;
constexpr int kHighestThreshold_db = 24;
/// A picture of a short recording is drawn finer.
constexpr Duration kShort = Duration::seconds(600);
constexpr std::size_t kFineWindows = 8;
/// All sound counts about alike.
constexpr std::size_t kHalfOverlapped = 2;
/// Below it a third octave is not much wider than a spectrum's bin.
constexpr Hertz kLowestThirdOctave{10.0};
/// A picture reaches so many times as high as the band.
constexpr double kPictureOverBand = 3.0;

/// A sample of full scale, less what its last steps may lack.
float full_scale_of(const Sequence& sequence) {
  return static_cast<float>(1.0 - 1.5 * std::exp2(1 - sequence.parts().front().format.bits));
}

}  // namespace

ChannelDetectors::ChannelDetectors(const Plan& plan, const Wanted& wanted)
    : decimator_(decimation_for(plan.sequence.sample_rate()), full_scale_of(plan.sequence)),
      channel_detector_(plan.settings, listening_rate(plan.sequence)),
      picture_windows_(plan.sequence.sample_rate(), plan.sequence.duration() < kShort ? kFineWindows : kHalfOverlapped),
      level_windows_(plan.sequence.sample_rate(), kHalfOverlapped) {
  const Hertz rate = plan.sequence.sample_rate();
  if (wanted.every_threshold) {
    for (int threshold_db = kLowestThreshold_db; threshold_db <= kHighestThreshold_db; ++threshold_db) {
      detector::SoundSettings settings = plan.settings;
      settings.detection_threshold = Decibels{static_cast<double>(threshold_db)};
      others_.emplace_back(settings, listening_rate(plan.sequence));
    }
  }
  if (wanted.spectrogram)
    spectrogram_ =
        std::make_unique<spectrum::Spectrogram>(plan.sequence.frames(), picture_windows_, kPictureOverBand * plan.settings.band.high);
  if (wanted.levels_interval_s)
    levels_ = std::make_unique<spectrum::BandLevels>(spectrum::third_octaves(kLowestThirdOctave, rate / 2.0), level_windows_.bin_width(),
                                                     static_cast<std::uint64_t>(std::llround(*wanted.levels_interval_s * rate.value)));
}

template <typename Do>
void ChannelDetectors::for_each(Do what) {
  what(channel_detector_);
  for (ChannelDetector& channel_detector : others_) what(channel_detector);
}

std::span<const float> ChannelDetectors::at_listening_rate(std::span<const float> samples) {
  return decimator_.factor() == 1 ? samples : decimator_.take(samples);
}

std::optional<Piece> ChannelDetectors::at_listening_rate(const Piece& piece) {
  const std::size_t factor = decimator_.factor();
  if (factor == 1) return piece;
  if (!piece.follows_on && piece.begin > 0) {
    decimator_.restart();
    is_broken_ = true;
    next_lower_ = (piece.begin + factor - 1) / factor;
  }
  const std::span<const float> lower = decimator_.take(piece.samples);
  if (lower.empty()) return std::nullopt;
  const Piece given{.begin = next_lower_, .part = piece.part, .follows_on = !is_broken_, .samples = lower};
  is_broken_ = false;
  next_lower_ += lower.size();
  return given;
}

void ChannelDetectors::prepare(std::span<const float> before) {
  const std::span<const float> lower = at_listening_rate(before);
  for_each([lower](ChannelDetector& channel_detector) { channel_detector.prepare(lower); });
}

void ChannelDetectors::learn_noise(const Piece& piece) {
  if (const std::optional<Piece> lower = at_listening_rate(piece))
    for_each([&lower](ChannelDetector& channel_detector) { channel_detector.learn_noise(*lower); });
}

void ChannelDetectors::begin_again() {
  decimator_.restart();
  next_lower_ = 0;
  is_broken_ = false;
  for_each([](ChannelDetector& channel_detector) { channel_detector.begin_again(); });
}

void ChannelDetectors::hear(const Piece& piece) {
  if (const std::optional<Piece> lower = at_listening_rate(piece))
    for_each([&lower](ChannelDetector& channel_detector) { channel_detector.hear(*lower); });
  const auto analyse = [&piece](spectrum::ShortTimeSpectrum& windows, auto* sink) {
    if (sink == nullptr) return;
    if (!piece.follows_on) windows.restart();
    windows.take(piece.samples, piece.begin, [sink](std::span<const float> psd, std::uint64_t begin) { sink->take(psd, begin); });
  };
  analyse(picture_windows_, spectrogram_.get());
  analyse(level_windows_, levels_.get());
}

void ChannelDetectors::finish(std::span<const float> after) {
  const std::span<const float> lower = at_listening_rate(after);
  for_each([lower](ChannelDetector& channel_detector) { channel_detector.finish(lower); });
  if (levels_) levels_->finish();
}

}  // namespace earshot::listening
