#include "sim/hydrophone/recorded_calls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>

#include "firmware/config/capacities.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::hydrophone {
namespace {

using host::BadInput;

constexpr Hertz kHeardAt{1000.0};         ///< the sample rate at which its level is measured
constexpr double kHalfOfFullScale = 0.5;  ///< its peak when its level is measured: nothing looks clipped
/// In the band there must be more than this share of the file's loudest sample, -70 dB: 80 dB down there is nothing but the filters'
/// leakage.
constexpr double kLeastShare = 3e-4;
/// The filters begin with silence; the recording is heard on beyond its end until they have forgotten that.
constexpr double kSettling_s = 15.0;

class Decimator {
 public:
  explicit Decimator(const detector::ListeningPlan& plan)
      : plan_(plan), first_(std::make_unique<History>()), second_(std::make_unique<History>()), low_(config::kSoundChunk) {}

  void take(std::span<const float> samples, std::vector<float>& out) {
    while (!samples.empty()) {
      const std::size_t go = std::min(samples.size(), config::kSoundChunk);
      std::copy_n(samples.begin(), go, first_->room(plan_.first));
      const std::size_t at_first_rate = first_->take(plan_.first, go, second_->room(plan_.second));
      const std::size_t made = second_->take(plan_.second, at_first_rate, low_.data());
      out.insert(out.end(), low_.begin(), low_.begin() + static_cast<std::ptrdiff_t>(made));
      samples = samples.subspan(go);
    }
  }

 private:
  using History = detector::FirHistory<config::kFirTaps>;
  const detector::ListeningPlan& plan_;
  std::unique_ptr<History> first_;
  std::unique_ptr<History> second_;
  std::vector<float> low_;
};

struct Taken {
  std::vector<float> samples;  ///< at the plan's low rate, the first sample of the file taken off: a constant voltage is no sound
  double peak = 0.0;           ///< of the file about that
};

Taken take(const std::filesystem::path& file, const recording::Sequence& sequence, const detector::ListeningPlan& plan) {
  const auto most = static_cast<std::uint64_t>(kMostRecorded_s * plan.sample_rate.value);
  recording::SequenceReader reader(sequence, 0, 1.0);
  Decimator decimator(plan);
  Taken taken;
  std::optional<float> reference;
  std::vector<float> about;
  while (const std::optional<recording::Piece> piece = reader.next()) {
    if (piece->begin >= most) break;
    about.assign(piece->samples.begin(), piece->samples.end());
    reference = reference.value_or(about.front());
    for (std::size_t i = 0; i < about.size(); ++i) {
      if (!std::isfinite(about[i]))
        throw BadInput(file.string() + ": sample " + std::to_string(piece->begin + i + 1) + " of the first channel is no finite number");
      about[i] -= *reference;
      taken.peak = std::max(taken.peak, static_cast<double>(std::abs(about[i])));
    }
    decimator.take(about, taken.samples);
  }
  return taken;
}

void require_audible(const std::filesystem::path& file, const recording::Sequence& sequence, const detector::SoundSettings& listening,
                     detector::ListeningPlan& plan) {
  std::ostringstream text;
  if (detector::make_plan(listening, sequence.sample_rate(), plan) != Status::kOk) {
    text << file.string() << ": is sampled at " << sequence.sample_rate().value << " Hz; to listen from " << listening.band.low.value
         << " to " << listening.band.high.value << " Hz takes a rate of some three times that, and 96000 Hz at most";
    throw BadInput(text.str());
  }
  if (sequence.duration() >= listening.integration_time) return;
  text << file.string() << ": holds " << sequence.duration().to_seconds() << " s of sound, less than the "
       << listening.integration_time.to_seconds() << " s over which the vehicle measures";
  throw BadInput(text.str());
}

/// Root mean square of the loudest integration time, as the vehicle's own detector has it; 0 where it hears nothing.
double loudest_in_band(const Recording& recording, const detector::SoundSettings& listening) {
  const auto sound_detector = std::make_unique<detector::SoundDetector>();
  if (sound_detector->configure(listening) != Status::kOk) return 0.0;
  const double recorded_s = static_cast<double>(recording.samples.size()) / recording.sample_rate.value;
  const auto count = static_cast<std::int64_t>((recorded_s + kSettling_s) * kHeardAt.value);
  std::vector<float> block(static_cast<std::size_t>(kHeardAt.value));
  double loudest_db = -INFINITY;
  for (std::int64_t begin = 0; begin < count; begin += static_cast<std::int64_t>(block.size())) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block[i] = static_cast<float>(recording.at(static_cast<double>(begin + static_cast<std::int64_t>(i)) / kHeardAt.value));
    sound_detector->hear({.time = {begin * 1000},
                          .sequence = begin,
                          .first_sample = begin,
                          .sample_rate = kHeardAt,
                          .gain = {},
                          .samples_per_channel = static_cast<std::uint32_t>(block.size()),
                          .overflow_count = 0,
                          .channels = 1},
                         block);
    while (const std::optional<detector::Estimate> estimate = sound_detector->next()) {
      if (estimate->hearing > detector::Hearing::kFloorUnsettled) continue;
      loudest_db = std::max(loudest_db, estimate->channels[0].level.value);
    }
  }
  return std::pow(10.0, (loudest_db - full_scale_level(listening.calibration, {}).value) / 20.0);
}

void scale(std::vector<float>& samples, double factor) {
  for (float& sample : samples) sample = static_cast<float>(factor * static_cast<double>(sample));
}

}  // namespace

Recording load_calls(const std::filesystem::path& file, const detector::SoundSettings& listening) {
  const recording::Sequence sequence({file});
  detector::ListeningPlan plan;
  require_audible(file, sequence, listening, plan);
  Taken taken = take(file, sequence, plan);
  if (!(taken.peak > 0.0)) throw BadInput(file.string() + ": is silent");
  scale(taken.samples, kHalfOfFullScale / taken.peak);
  Recording recording{.samples = std::move(taken.samples), .sample_rate = plan.low_rate};
  const double loudest = loudest_in_band(recording, listening);
  if (!(loudest > kLeastShare)) {
    std::ostringstream text;
    text << file.string() << ": holds no sound from " << listening.band.low.value << " to " << listening.band.high.value
         << " Hz within 70 dB of its loudest sample";
    throw BadInput(text.str());
  }
  scale(recording.samples, 1.0 / loudest);
  return recording;
}

}  // namespace earshot::hydrophone
