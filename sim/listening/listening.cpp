#include "sim/listening/listening.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace earshot::listening {
namespace {

using detector::Hearing;
using recording::Piece;
using recording::Sequence;
using recording::SequenceReader;

/// Shares of full scale: below what any ADC's highest step is.
constexpr float kNearlyFullScale = 0.99F;

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
std::vector<float> before_beginning(const Listening::Source& source, std::size_t lead) {
  std::vector<float> first;
  for (std::optional<Piece> piece = source(); piece && piece->part == 0 && first.size() <= lead; piece = source())
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

std::vector<Row> rows_of(const ChannelDetector& channel_detector, const Plan& plan, std::size_t first) {
  const Decibels correction = correction_of(plan);
  std::vector<Row> rows;
  for (std::size_t i = first; i < channel_detector.detections().size(); ++i) {
    const detector::Detection& detection = channel_detector.detections()[i];
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

}  // namespace

std::string missing_to_string(const Heard& heard) {
  return std::to_string(heard.missing_frames) + " samples that the headers announce could not be read: a file is cut short or damaged";
}

std::uint64_t Listening::beginning() const {
  const auto learnt = static_cast<std::uint64_t>(std::ceil(plan_.settings.floor_window.to_seconds() * plan_.sequence.sample_rate().value));
  return std::max<std::uint64_t>(learnt, detectors_.lead()) + recording::kPieceFrames;
}

void Listening::learn(const std::function<Source()>& from_start, const Progress& progress) {
  const Time learnt = Time{} + plan_.settings.floor_window;
  const std::vector<float> before = before_beginning(from_start(), detectors_.lead());
  if (!before.empty()) detectors_.prepare(before);
  const Source beginning = from_start();
  for (std::optional<Piece> piece = beginning(); piece && plan_.sequence.time_of(piece->begin) < learnt; piece = beginning()) {
    detectors_.learn_noise(*piece);
    progress(0.0);
  }
  detectors_.begin_again();
  if (!before.empty()) detectors_.prepare(before);
}

void Listening::hear(const Piece& piece) {
  detectors_.hear(piece);
  keep_last(last_, piece.samples, detectors_.tail() + 1);
}

void Listening::finish() {
  detectors_.finish(after_end(last_));
}

std::vector<Row> Listening::rows(std::size_t first) const {
  return rows_of(detectors_.channel_detector(), plan_, first);
}

Heard Listening::heard(std::uint64_t missing_frames) {
  const ChannelDetector& channel_detector = detectors_.channel_detector();
  require_heard(channel_detector, plan_);
  Heard heard;
  heard.rows = rows();
  heard.listened_s = channel_detector.listened().to_seconds();
  heard.noise_db = (channel_detector.mean_floor() + correction_of(plan_)).value;
  heard.obstacles = obstacles_of(channel_detector, plan_.sequence, missing_frames);
  heard.missing_frames = missing_frames;
  for (const ChannelDetector& other : detectors_.others())
    heard.others.push_back({.threshold_db = other.settings().detection_threshold.value, .rows = rows_of(other, plan_, 0)});
  heard.spectrogram = detectors_.take_spectrogram();
  heard.levels = detectors_.take_levels();
  return heard;
}

Heard listen_to(const Plan& plan, const Wanted& wanted, const Progress& progress) {
  Listening listening(plan, wanted);
  const auto reader = [&plan] { return std::make_shared<SequenceReader>(plan.sequence, plan.channel, plan.chain.divisor); };
  listening.learn([&reader] { return [files = reader()] { return files->next(); }; }, progress);
  const std::shared_ptr<SequenceReader> all = reader();
  while (const std::optional<Piece> piece = all->next()) {
    listening.hear(*piece);
    progress(static_cast<double>(piece->begin) / static_cast<double>(plan.sequence.frames()));
  }
  listening.finish();
  return listening.heard(all->missing_frames());
}

annotation::Score score_of(const std::vector<Row>& rows, const std::vector<annotation::Interval>& truth, double tolerance_s,
                           double listened_s) {
  std::vector<annotation::Interval> found;
  for (const Row& row : rows) found.push_back({row.begin_s, row.begin_s + row.duration_s});
  return annotation::score(truth, found, tolerance_s, listened_s / 3600.0);
}

}  // namespace earshot::listening
