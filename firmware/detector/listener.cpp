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

/// A mean that is no further above the floor may be the upper part of what was there: noise of 8 dB, the most in the worlds that policies
/// are judged in, then has lost a sixth of its looks and the mean reads 2.5 dB too loud.
constexpr Decibels kClearOfFloor{10.0};

WindowReception alone(const messages::SnrMeasurement& look) {
  return {.snr = look.snr, .too_faint = look.too_faint, .looks = 1, .measured = look.too_faint ? 0U : 1U};
}

}  // namespace

void Listener::Second::add(const messages::SnrMeasurement& look) {
  const bool is_first = look.too_faint ? looks == measured : measured == 0;
  Decibels& most = look.too_faint ? highest_floor : loudest;
  most = is_first ? look.snr : std::max(most, look.snr);
  ++looks;
  if (look.too_faint) return;
  sum += look.snr;
  ++measured;
}

void Listener::Second::add(const Second& other) {
  if (other.looks > other.measured) highest_floor = looks > measured ? std::max(highest_floor, other.highest_floor) : other.highest_floor;
  if (other.measured > 0) loudest = measured > 0 ? std::max(loudest, other.loudest) : other.loudest;
  sum += other.sum;
  looks += other.looks;
  measured += other.measured;
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
  Second all;
  for (std::int64_t s = first; s <= last_second_; ++s) all.add(seconds_[slot_of(s)]);
  if (all.looks == 0) return alone(*newest_);
  if (all.measured == 0) return {.snr = all.highest_floor, .too_faint = true, .looks = all.looks};
  WindowReception reception{.snr = all.loudest, .looks = all.looks, .measured = all.measured};
  if (window.listening != config::Listening::kMean) return reception;
  reception.snr = all.sum / static_cast<double>(all.measured);
  const bool may_be_cut_off = all.looks > all.measured && reception.snr < all.highest_floor + kClearOfFloor;
  return may_be_cut_off ? alone(*newest_) : reception;
}

}  // namespace earshot::detector
