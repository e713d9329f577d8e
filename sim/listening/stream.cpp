#include "sim/listening/stream.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace earshot::listening {
namespace {

using recording::kPieceFrames;
using recording::Piece;
using recording::Sequence;

/// What is pushed at once waits in pieces of that many samples: a large block takes little memory besides its own.
constexpr std::size_t kTakenAtOnce = 64 * kPieceFrames;

}  // namespace

Sequence sequence_of_samples(const recording::SoundFormat& format, std::optional<Time> start) {
  recording::Part part;
  part.path = "samples";
  part.format = format;
  part.notes.start = start;
  return Sequence::of_parts({part});
}

Stream::Stream(Plan plan, const Wanted& wanted) : plan_(std::move(plan)), listening_(plan_, wanted) {}

Listening::Source Stream::pieces() const {
  return [this, at = std::size_t{0}]() mutable -> std::optional<Piece> {
    const std::size_t count = std::min(waiting_.size() - at, kPieceFrames);
    if (count == 0 || (count < kPieceFrames && !is_over_)) return std::nullopt;
    const std::uint64_t begin = heard_ + at;
    const auto samples = std::span(waiting_).subspan(at, count);
    at += count;
    return Piece{.begin = begin, .part = 0, .follows_on = begin > 0, .samples = samples};
  };
}

void Stream::learn(const Progress& progress) {
  listening_.learn([this] { return pieces(); }, progress);
  has_learnt_ = true;
}

void Stream::push(std::span<const float> samples, const Progress& progress) {
  const auto scale = static_cast<float>(1.0 / plan_.chain.divisor);
  for (std::size_t begin = 0; begin < samples.size(); begin += kTakenAtOnce) {
    const auto taken = samples.subspan(begin, std::min(samples.size() - begin, kTakenAtOnce));
    std::ranges::transform(taken, std::back_inserter(waiting_), [scale](float sample) { return scale * sample; });
    if (!has_learnt_ && waiting_.size() < listening_.beginning()) continue;
    if (!has_learnt_) learn(progress);
    hear_waiting(progress, static_cast<double>(begin) / static_cast<double>(samples.size()));
  }
}

void Stream::hear_waiting(const Progress& progress, double share) {
  const Listening::Source next = pieces();
  std::size_t heard = 0;
  while (const std::optional<Piece> piece = next()) {
    listening_.hear(*piece);
    heard += piece->samples.size();
    progress(share);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(heard));
  heard_ += heard;
}

Heard Stream::finish(const Progress& progress) {
  is_over_ = true;
  recording::Part part = plan_.sequence.parts().front();
  part.frames = heard_ + waiting_.size();
  plan_.sequence = Sequence::of_parts({part});
  if (!has_learnt_) learn(progress);
  hear_waiting(progress, 1.0);
  listening_.finish();
  return listening_.heard(0);
}

}  // namespace earshot::listening
