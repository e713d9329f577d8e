#include "firmware/detector/snr_window.hpp"

#include <algorithm>
#include <cassert>

namespace earshot::detector {
namespace {

constexpr auto kRing = static_cast<std::int64_t>(config::kMaxListeningSeconds);

/// The second of the clock that an instant lies in; the first second ends at the epoch + 1 s, and measurements at a second's very end are
/// the next one's.
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
/// are judged in, then has lost a sixth of its measurements and the mean reads 2.5 dB too loud.
constexpr Decibels kClearOfFloor{10.0};

WindowReception alone(const messages::SnrMeasurement& measurement) {
  return {.snr = measurement.snr, .too_faint = measurement.too_faint, .measurements = 1, .measured = measurement.too_faint ? 0U : 1U};
}

}  // namespace

void SnrWindow::Second::add(const messages::SnrMeasurement& measurement) {
  const bool is_first = measurement.too_faint ? measurements == measured : measured == 0;
  Decibels& most = measurement.too_faint ? highest_floor : loudest;
  most = is_first ? measurement.snr : std::max(most, measurement.snr);
  ++measurements;
  if (measurement.too_faint) return;
  sum += measurement.snr;
  ++measured;
}

void SnrWindow::Second::add(const Second& other) {
  if (other.measurements > other.measured)
    highest_floor = measurements > measured ? std::max(highest_floor, other.highest_floor) : other.highest_floor;
  if (other.measured > 0) loudest = measured > 0 ? std::max(loudest, other.loudest) : other.loudest;
  sum += other.sum;
  measurements += other.measurements;
  measured += other.measured;
}

void SnrWindow::begin_leg(Time now) {
  is_empty_ = true;
  leg_began_ = now;
}

void SnrWindow::forget_up_to(std::int64_t second) {
  const std::int64_t first = is_empty_ ? second - kRing + 1 : std::max(last_second_ + 1, second - kRing + 1);
  for (std::int64_t s = first; s <= second; ++s) seconds_[slot_of(s)] = {};
  last_second_ = second;
  is_empty_ = false;
}

void SnrWindow::take(const messages::SnrMeasurement& measurement) {
  if (!newest_ || measurement.time >= newest_->time) newest_ = measurement;
  if (leg_began_ && measurement.time < *leg_began_) return;
  const std::int64_t second = second_of(measurement.time);
  if (is_empty_ || second > last_second_) forget_up_to(second);
  if (second > last_second_ - kRing) seconds_[slot_of(second)].add(measurement);
}

WindowReception SnrWindow::reception(config::ListeningWindow window, Time now) const {
  assert(newest_ && config::is_valid(window));
  if (window.listening == config::Listening::kNewest || is_empty_) return alone(*newest_);
  const std::int64_t last = std::max(second_of(now), last_second_);
  const std::int64_t first = last - window.length.us / Duration::seconds(1).us + 1;  // no earlier than the ring reaches
  Second all;
  for (std::int64_t s = first; s <= last_second_; ++s) all.add(seconds_[slot_of(s)]);
  if (all.measurements == 0) return alone(*newest_);
  if (all.measured == 0) return {.snr = all.highest_floor, .too_faint = true, .measurements = all.measurements};
  WindowReception reception{.snr = all.loudest, .measurements = all.measurements, .measured = all.measured};
  if (window.listening != config::Listening::kMean) return reception;
  reception.snr = all.sum / static_cast<double>(all.measured);
  const bool may_be_cut_off = all.measurements > all.measured && reception.snr < all.highest_floor + kClearOfFloor;
  return may_be_cut_off ? alone(*newest_) : reception;
}

}  // namespace earshot::detector
