#include "firmware/detector/listener.hpp"

#include <algorithm>
#include <cassert>

namespace earshot::detector {
namespace {

constexpr auto kRing = static_cast<std::int64_t>(config::kMaxListeningSeconds);

/// The second of the clock that an instant lies in; the first second ends at the epoch + 1 s, and looks at a second's very end are the
/// next one's.
std::int64_t second_of(Time time) {
  constexpr std::int64_t kSecond = Duration::seconds(1).us;
  const std::int64_t whole = time.us / kSecond;
  return time.us % kSecond < 0 ? whole - 1 : whole;
}

std::size_t slot_of(std::int64_t second) {
  const std::int64_t rest = second % kRing;
  return static_cast<std::size_t>(rest < 0 ? rest + kRing : rest);
}

WindowReception alone(const messages::SnrMeasurement& look) {
  return {.snr = look.snr, .too_faint = look.too_faint, .looks = 1, .measured = look.too_faint ? 0U : 1U};
}

}  // namespace

void Listener::Second::add(const messages::SnrMeasurement& look) {
  const bool is_first = looks == 0 || (measured == 0 && !look.too_faint);
  ++looks;
  if (look.too_faint && measured > 0) return;
  level = is_first ? look.snr : std::max(level, look.snr);
  if (look.too_faint) return;
  sum += look.snr;
  ++measured;
}

void Listener::begin_leg(Time now) {
  is_empty_ = true;
  leg_began_ = now;
}

void Listener::forget_up_to(std::int64_t second) {
  const std::int64_t first = is_empty_ ? second - kRing + 1 : std::max(last_second_ + 1, second - kRing + 1);
  for (std::int64_t s = first; s <= second; ++s) seconds_[slot_of(s)] = {};
  last_second_ = second;
  is_empty_ = false;
}

void Listener::take(const messages::SnrMeasurement& look) {
  if (!newest_ || look.time >= newest_->time) newest_ = look;
  if (leg_began_ && look.time < *leg_began_) return;
  const std::int64_t second = second_of(look.time);
  if (is_empty_ || second > last_second_) forget_up_to(second);
  if (second > last_second_ - kRing) seconds_[slot_of(second)].add(look);
}

WindowReception Listener::reception(config::ListeningWindow window, Time now) const {
  assert(newest_ && config::is_valid(window));
  if (window.listening == config::Listening::kNewest || is_empty_) return alone(*newest_);
  const std::int64_t last = std::max(second_of(now), last_second_);
  const std::int64_t first = last - window.length.us / Duration::seconds(1).us + 1;  // no earlier than the ring reaches
  WindowReception reception;
  Decibels sum;
  Decibels floor{-1e9};
  for (std::int64_t s = first; s <= last_second_; ++s) {
    const Second& second = seconds_[slot_of(s)];
    if (second.looks == 0) continue;
    const bool is_first = reception.looks == 0 || (reception.measured == 0 && second.measured > 0);
    if (is_first || (second.measured > 0) == (reception.measured > 0))
      reception.snr = is_first ? second.level : std::max(reception.snr, second.level);
    sum += second.sum;
    if (second.measured == 0) floor = std::max(floor, second.level);
    reception.looks += second.looks;
    reception.measured += second.measured;
  }
  if (reception.looks == 0) return alone(*newest_);
  reception.too_faint = reception.measured == 0;
  if (!reception.too_faint && window.listening == config::Listening::kMean) {
    reception.snr = sum / static_cast<double>(reception.measured);
    if (reception.snr < floor + Decibels{10.0}) return alone(*newest_);
  }
  return reception;
}

}  // namespace earshot::detector
