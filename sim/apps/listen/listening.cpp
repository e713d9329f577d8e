#include "sim/apps/listen/listening.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/apps/listen/decimator.hpp"
#include "sim/apps/listen/truth.hpp"
#include "sim/recording/clock_text.hpp"
#include "sim/spectrum/short_time_spectrum.hpp"

namespace earshot::listen {
namespace {

using detector::Hearing;
using recording::Piece;
using recording::Sequence;
using recording::SequenceReader;

/// What the detector takes for full scale; only differences of level count in it.
constexpr Decibels kNominalFullScale{180.0};
/// Thresholds of a curve, dB.
constexpr int kLowestThreshold_db = 0;
constexpr int kHighestThreshold_db = 24;
/// A picture of a short recording is drawn finer.
constexpr Duration kShort = Duration::seconds(600);
/// Below it a third octave is not much wider than a spectrum's bin.
constexpr Hertz kLowestThirdOctave{10.0};
/// Shares of full scale: below what any ADC's highest step is.
constexpr float kNearlyFullScale = 0.99F;
/// No hydrophone's recorder takes more; beyond it a number is damage.
constexpr Hertz kHighestSampleRate{1'000'000.0};
/// A picture reaches so many times as high as the band.
constexpr double kPictureOverBand = 3.0;

std::string name_of(const Sequence& sequence) {
  const std::string first = sequence.parts().front().path.string();
  return sequence.files() == 1 ? first : first + " and " + std::to_string(sequence.files() - 1) + " more";
}

host::BadInput unheard(const Sequence& sequence, const std::string& why) {
  return host::BadInput(name_of(sequence) + ": cannot be listened to: " + why);
}

/// The recording's own, or what it is decimated to.
Hertz listening_rate(const Sequence& sequence) {
  return sequence.sample_rate() / static_cast<double>(decimation_for(sequence.sample_rate()));
}

/// Steps of the ADC as the noise of one would be at the rate that is listened to: four times the rate spreads it as a bit more does.
int bits_at_listening_rate(const Sequence& sequence) {
  const int bits = sequence.parts().front().format.bits;
  const double more = std::floor(std::log2(static_cast<double>(decimation_for(sequence.sample_rate()))) / 2.0);
  return std::min(bits + static_cast<int>(more), std::max(bits, 24));
}

std::string band_text(detector::Band band) {
  std::ostringstream text;
  text.precision(4);
  text << band.low.value << " to " << band.high.value << " Hz";
  return text.str();
}

void require_audible(const Sequence& sequence, const detector::SoundSettings& settings, detector::Band asked) {
  std::ostringstream rate;
  rate.precision(9);
  rate << "it is sampled at " << sequence.sample_rate().value << " Hz";
  if (sequence.sample_rate() > kHighestSampleRate) {
    rate << ", and no more than " << kHighestSampleRate.value << " Hz are taken: resample it";
    throw unheard(sequence, rate.str());
  }
  const detector::SettingsFault fault = detector::check(settings);
  if (fault == detector::SettingsFault::kNone) return;
  if (settings.band != asked) throw unheard(sequence, rate.str() + ", too slowly for the band of " + band_text(asked));
  if (fault == detector::SettingsFault::kCalibration)
    throw unheard(sequence, detector::to_string(detector::check(settings.calibration, Decibels{0.0}, listening_rate(sequence),
                                                                settings.band, settings.expected_noise)));
  throw host::BadInput(detector::to_string(fault));
}

Chain chain_for(const Arguments& arguments, const Sequence& sequence, std::vector<std::string>& remarks) {
  if (!arguments.calibration.empty()) return read_calibration(arguments.calibration);
  if (arguments.full_scale_level_db) return {.full_scale_level = Decibels{*arguments.full_scale_level_db}, .from = "--full-scale-db"};
  std::string remark;
  Chain chain = chain_of_recorders(sequence, remark);
  if (!remark.empty()) remarks.push_back(remark);
  return chain;
}

/// Everything that hears at once.
class ChannelDetectors {
 public:
  ChannelDetectors(const Plan& plan, const Arguments& arguments)
      : plan_(plan),
        decimator_(decimation_for(plan.sequence.sample_rate()), full_scale_of(plan.sequence)),
        channel_detector_(plan.settings, listening_rate(plan.sequence)),
        windows_(plan.sequence.sample_rate(), plan.sequence.duration() < kShort ? 8 : 2) {
    if (!arguments.roc.empty()) {
      for (int threshold_db = kLowestThreshold_db; threshold_db <= kHighestThreshold_db; ++threshold_db) {
        detector::SoundSettings settings = plan.settings;
        settings.detection_threshold = Decibels{static_cast<double>(threshold_db)};
        others_.emplace_back(settings, listening_rate(plan.sequence));
      }
    }
    if (!arguments.spectrogram.empty())
      spectrogram_ = std::make_unique<spectrum::Spectrogram>(plan.sequence.frames(), windows_, kPictureOverBand * plan.settings.band.high);
    if (!arguments.levels.empty()) levels_ = levels_for(arguments.levels_interval_s);
  }

  /// Samples of the recording.
  [[nodiscard]] std::size_t lead() const { return (channel_detector_.lead() + reach()) * decimator_.factor(); }
  [[nodiscard]] std::size_t tail() const { return (channel_detector_.tail() + reach()) * decimator_.factor(); }

  void prepare(std::span<const float> before) {
    const std::span<const float> lower = at_listening_rate(before);
    for_each([lower](ChannelDetector& channel_detector) { channel_detector.prepare(lower); });
  }
  void learn_noise(const Piece& piece) {
    if (const std::optional<Piece> lower = at_listening_rate(piece))
      for_each([&lower](ChannelDetector& channel_detector) { channel_detector.learn_noise(*lower); });
  }
  void begin_again() {
    decimator_.restart();
    next_lower_ = 0;
    is_broken_ = false;
    for_each([](ChannelDetector& channel_detector) { channel_detector.begin_again(); });
  }

  void hear(const Piece& piece) {
    if (const std::optional<Piece> lower = at_listening_rate(piece))
      for_each([&lower](ChannelDetector& channel_detector) { channel_detector.hear(*lower); });
    if (!spectrogram_ && !levels_) return;
    if (!piece.follows_on) windows_.restart();
    windows_.take(piece.samples, piece.begin, [this](std::span<const float> psd, std::uint64_t begin) {
      if (spectrogram_) spectrogram_->take(psd, begin);
      if (levels_) levels_->take(psd, begin);
    });
  }

  void finish(std::span<const float> after) {
    const std::span<const float> lower = at_listening_rate(after);
    for_each([lower](ChannelDetector& channel_detector) { channel_detector.finish(lower); });
    if (levels_) levels_->finish();
  }

  [[nodiscard]] const ChannelDetector& channel_detector() const { return channel_detector_; }
  [[nodiscard]] const std::vector<ChannelDetector>& others() const { return others_; }
  [[nodiscard]] std::unique_ptr<spectrum::Spectrogram> spectrogram() { return std::move(spectrogram_); }
  [[nodiscard]] std::unique_ptr<spectrum::BandLevels> levels() { return std::move(levels_); }

 private:
  /// A sample of full scale, less what its last steps may lack.
  [[nodiscard]] static float full_scale_of(const Sequence& sequence) {
    return static_cast<float>(1.0 - 1.5 * std::exp2(1 - sequence.parts().front().format.bits));
  }

  [[nodiscard]] std::size_t reach() const { return decimator_.factor() == 1 ? 0 : 2 * Decimator::kReach; }

  [[nodiscard]] std::span<const float> at_listening_rate(std::span<const float> samples) {
    return decimator_.factor() == 1 ? samples : decimator_.take(samples);
  }

  /// Nothing where the piece completes no sample.
  [[nodiscard]] std::optional<Piece> at_listening_rate(const Piece& piece) {
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

  template <typename Do>
  void for_each(Do what) {
    what(channel_detector_);
    for (ChannelDetector& channel_detector : others_) what(channel_detector);
  }

  [[nodiscard]] std::unique_ptr<spectrum::BandLevels> levels_for(double interval_s) const {
    const Hertz rate = plan_.sequence.sample_rate();
    const auto interval = static_cast<std::uint64_t>(std::llround(interval_s * rate.value));
    return std::make_unique<spectrum::BandLevels>(spectrum::third_octaves(kLowestThirdOctave, rate / 2.0), windows_.bin_width(), interval);
  }

  const Plan& plan_;
  Decimator decimator_;
  std::uint64_t next_lower_ = 0;  ///< number of the sample that the decimator gives next
  bool is_broken_ = false;        ///< it does not follow on the last
  ChannelDetector channel_detector_;
  std::vector<ChannelDetector> others_;
  spectrum::ShortTimeSpectrum windows_;
  std::unique_ptr<spectrum::Spectrogram> spectrogram_;
  std::unique_ptr<spectrum::BandLevels> levels_;
};

/// Sound turned about its first sample, in time and in sign: it goes on from what is turned without a step or a bend.
/// @return nothing where that would be beyond full scale: the recorder was switched on, or the sound is clipped
std::vector<float> turned(std::span<const float> samples) {
  std::vector<float> result;
  for (std::size_t i = samples.size(); i-- > 1;) {
    result.push_back(2.0F * samples[0] - samples[i]);
    if (!(std::abs(result.back()) < kNearlyFullScale)) return {};
  }
  return result;
}

/// What stands for the sound before the recording, so that the filters are full when it begins.
std::vector<float> before_beginning(const Plan& plan, std::size_t lead) {
  std::vector<float> first;
  SequenceReader reader(plan.sequence, plan.channel, plan.chain.divisor);
  for (std::optional<Piece> piece = reader.next(); piece && piece->part == 0 && first.size() <= lead; piece = reader.next())
    first.insert(first.end(), piece->samples.begin(), piece->samples.end());
  first.resize(std::min(first.size(), lead + 1));
  if (first.size() <= lead) return {};
  return turned(first);
}

void keep_last(std::vector<float>& last, std::span<const float> samples, std::size_t most) {
  last.insert(last.end(), samples.begin(), samples.end());
  if (last.size() > most) last.erase(last.begin(), last.end() - static_cast<std::ptrdiff_t>(most));
}

/// What stands for the sound after the recording.
std::vector<float> after_end(std::vector<float> last) {
  std::ranges::reverse(last);
  std::vector<float> after = turned(last);
  std::ranges::reverse(after);
  return after;
}

/// Reads the recording twice: its beginning for the noise, then all of it. @return frames that were promised and not there
std::uint64_t run(const Plan& plan, ChannelDetectors& detectors) {
  program::ProgressBar bar("listening");
  const Time learnt = Time{} + plan.settings.floor_window;
  const std::vector<float> before = before_beginning(plan, detectors.lead());
  if (!before.empty()) detectors.prepare(before);
  SequenceReader beginning(plan.sequence, plan.channel, plan.chain.divisor);
  for (std::optional<Piece> piece = beginning.next(); piece && plan.sequence.time_of(piece->begin) < learnt; piece = beginning.next())
    detectors.learn_noise(*piece);
  detectors.begin_again();
  if (!before.empty()) detectors.prepare(before);
  SequenceReader all(plan.sequence, plan.channel, plan.chain.divisor);
  std::vector<float> last;
  while (const std::optional<Piece> piece = all.next()) {
    detectors.hear(*piece);
    keep_last(last, piece->samples, detectors.tail() + 1);
    bar.update(static_cast<double>(piece->begin) / static_cast<double>(plan.sequence.frames()));
  }
  detectors.finish(after_end(last));
  return all.missing_frames();
}

std::vector<Row> rows_of(const ChannelDetector& channel_detector, const Plan& plan, Decibels correction) {
  std::vector<Row> rows;
  for (const detector::Detection& detection : channel_detector.detections()) {
    // A call that sounds when the recording begins may be dated a little before it.
    const Time begin = std::max(detection.begin, Time{});
    const Time end = detection.begin + detection.duration;
    rows.push_back({.begin_s = (begin - Time{}).to_seconds(),
                    .duration_s = (end - begin).to_seconds(),
                    .peak_s = (detection.peak - Time{}).to_seconds(),
                    .level_db = (detection.peak_level + correction).value,
                    .snr_db = detection.peak_snr.value,
                    .place = plan.sequence.place_of(begin),
                    .is_clipped = detection.worst == Hearing::kClipped});
  }
  return rows;
}

/// When it did not hear, and when what it heard was clipped; with what it heard as long as the recording is. To the detector a place where
/// sound does not go on is one where samples are missing: of a recording none are, its filters begin anew there, and a share of the first
/// quarter goes with them.
std::vector<Heard::Obstacle> obstacles_of(const ChannelDetector& channel_detector, const Sequence& sequence, std::uint64_t missing_frames) {
  const double unread_s = static_cast<double>(missing_frames) / sequence.sample_rate().value;
  double rest_s = sequence.duration().to_seconds() - channel_detector.listened().to_seconds() - unread_s;
  std::vector<Heard::Obstacle> obstacles;
  for (std::size_t i = 1; i < detector::kHearings; ++i) {
    const auto hearing = static_cast<Hearing>(i);
    if (hearing == Hearing::kDropout || channel_detector.time_of(hearing).us == 0) continue;
    obstacles.push_back({detector::to_string(hearing), channel_detector.time_of(hearing).to_seconds()});
    if (hearing != Hearing::kClipped) rest_s -= obstacles.back().seconds;
  }
  if (missing_frames > 0) obstacles.push_back({"samples could not be read", unread_s});
  if (channel_detector.time_of(Hearing::kDropout).us > 0 && rest_s > 0.0)
    obstacles.push_back({"the filters begin anew where sound does not go on", rest_s});
  return obstacles;
}

void require_heard(const ChannelDetector& channel_detector, const Plan& plan) {
  if (channel_detector.listened().us > 0) return;
  const Hearing obstacle = channel_detector.main_obstacle();
  if (obstacle == Hearing::kHears || obstacle == Hearing::kFillingUp || obstacle == Hearing::kFloorUnsettled) {
    std::ostringstream text;
    text << plan.sequence.duration().to_seconds() << " s of sound are too short to know the noise and measure a call against it: "
         << "it takes some " << 5.0 * plan.settings.integration_time.to_seconds() << " s";
    throw unheard(plan.sequence, text.str());
  }
  throw unheard(plan.sequence, detector::to_string(obstacle));
}

recording::StatedTimes stated_times(const Arguments& arguments) {
  recording::StatedTimes stated{.name_format = arguments.time_format};
  if (!arguments.begin.empty()) stated.begin = recording::read_iso(arguments.begin)->utc;
  return stated;
}

}  // namespace

Plan plan_for(const Arguments& arguments) {
  const std::vector<std::filesystem::path> paths(arguments.files.begin(), arguments.files.end());
  Plan plan{.sequence = Sequence(paths, stated_times(arguments)),
            .channel = arguments.channel - 1,
            .chain = {},
            .settings = settings_of(arguments),
            .asked = {},
            .truth = {},
            .remarks = {}};
  const Sequence& sequence = plan.sequence;
  if (plan.channel >= sequence.channels())
    throw host::BadInput("--channel = " + std::to_string(arguments.channel) + ": " + name_of(sequence) + " has " +
                         std::to_string(sequence.channels()));
  plan.remarks = sequence.remarks();
  plan.chain = chain_for(arguments, sequence, plan.remarks);
  plan.chain.divisor = divisor_for(sequence);
  plan.asked = plan.settings.band;
  plan.settings.band = detector::audible_part(plan.asked, sequence.sample_rate());
  plan.settings.calibration = {.sensitivity = -kNominalFullScale,
                               .fixed_gain = Decibels{0.0},
                               .full_scale_volts = 1.0,
                               .adc_bits = bits_at_listening_rate(sequence),
                               .high_pass_corner = plan.chain.high_pass_corner};
  require_audible(sequence, plan.settings, plan.asked);
  if (!arguments.truth.empty()) {
    const Listened listened{.sequence = sequence, .channel = arguments.channel, .band = plan.settings.band};
    Truth truth = truth_of(annotation::read_selection_table(arguments.truth), arguments.truth, listened);
    plan.truth = std::move(truth.intervals);
    plan.remarks.insert(plan.remarks.end(), truth.remarks.begin(), truth.remarks.end());
  }
  return plan;
}

Heard listen_to(const Plan& plan, const Arguments& arguments) {
  ChannelDetectors detectors(plan, arguments);
  Heard heard;
  heard.missing_frames = run(plan, detectors);
  const ChannelDetector& channel_detector = detectors.channel_detector();
  require_heard(channel_detector, plan);
  const Decibels correction = plan.chain.correction() - kNominalFullScale;
  heard.rows = rows_of(channel_detector, plan, correction);
  heard.listened_s = channel_detector.listened().to_seconds();
  heard.noise_db = (channel_detector.mean_floor() + correction).value;
  heard.obstacles = obstacles_of(channel_detector, plan.sequence, heard.missing_frames);
  for (const ChannelDetector& other : detectors.others())
    heard.curve.push_back({.threshold_db = other.settings().detection_threshold.value,
                           .score = score_of(rows_of(other, plan, correction), plan, arguments.tolerance_s, heard.listened_s)});
  heard.spectrogram = detectors.spectrogram();
  heard.levels = detectors.levels();
  return heard;
}

annotation::Score score_of(const std::vector<Row>& rows, const Plan& plan, double tolerance_s, double listened_s) {
  std::vector<annotation::Interval> found;
  for (const Row& row : rows) found.push_back({row.begin_s, row.begin_s + row.duration_s});
  return annotation::score(plan.truth, found, tolerance_s, listened_s / 3600.0);
}

}  // namespace earshot::listen
