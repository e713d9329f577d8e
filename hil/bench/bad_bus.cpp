#include "hil/bench/bad_bus.hpp"

#include <algorithm>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::hil {
namespace {

/// Whether its second byte is the length of a message of several frames.
bool begins_fast_packet(const n2k::Frame& frame) {
  const n2k::Message* const message = n2k::find_message(n2k::parse_identifier(frame.identifier).value().pgn);
  return message != nullptr && message->framing == n2k::Framing::kFast && frame.size > 1 && (frame.data[0] & 0x1FU) == 0;
}

}  // namespace

bool Passage::lose_or_delay(Fault fault, Duration seconds, Pcg32& random) {
  switch (fault) {
    case Fault::kLoss:
      times = 0;
      return true;
    case Fault::kDelay:
      late = late + seconds;
      return true;
    case Fault::kJitter:
      late = late + Duration{static_cast<std::int64_t>(random.uniform_double() * static_cast<double>(seconds.us))};
      return true;
    default:
      return false;
  }
}

Frames BadBus::pass(const Frames& frames, const std::vector<Affliction>& afflictions, Time now) {
  Frames arriving;
  const auto is_due = [now](const Late& late) { return late.due <= now; };
  std::ranges::stable_sort(late_, {}, &Late::due);
  for (const Late& late : late_) {
    if (is_due(late)) arriving.push_back(late.frame);
  }
  std::erase_if(late_, is_due);
  for (const n2k::Frame& frame : frames) pass(frame, afflictions, now, arriving);
  return arriving;
}

void BadBus::pass(const n2k::Frame& frame, const std::vector<Affliction>& afflictions, Time now, Frames& arriving) {
  Fate fate{.frame = frame, .passage = {}};
  for (const Affliction& affliction : afflictions) {
    if (!hits(affliction.frames, fate.frame)) continue;
    if (inject(affliction, now, fate)) ++afflicted_;
    if (fate.passage.times == 0) return;
  }
  for (; fate.passage.times > 0; --fate.passage.times) {
    if (fate.passage.late > Duration{}) {
      late_.push_back({.due = now + fate.passage.late, .frame = fate.frame});
    } else {
      arriving.push_back(fate.frame);
    }
  }
}

bool BadBus::inject(const Affliction& affliction, Time now, Fate& fate) {
  if (fate.passage.lose_or_delay(affliction.fault, affliction.seconds, random_)) return true;
  n2k::Frame& frame = fate.frame;
  const n2k::Frame before = frame;
  switch (affliction.fault) {
    case Fault::kDuplication:
      ++fate.passage.times;
      return true;
    case Fault::kReplay:
      late_.push_back({.due = now + affliction.seconds, .frame = frame});
      return true;
    case Fault::kCorruption:
      if (frame.size > 0) frame.data.at(random_.next() % frame.size) ^= static_cast<std::uint8_t>(1U << random_.next() % 8U);
      break;
    case Fault::kNotAvailable:
      std::fill_n(frame.data.begin(), frame.size, std::uint8_t{0xFF});
      break;
    case Fault::kTruncation:
      frame.size /= 2;
      break;
    case Fault::kWrongLength:
      if (begins_fast_packet(frame)) frame.data[1] = static_cast<std::uint8_t>(frame.data[1] + 1U + random_.next() % 255U);
      break;
    default:
      throw NoMaker(affliction.fault, "of frames on a CAN bus");
  }
  return frame != before;
}

bool BadBus::hits(const AfflictedFrames& which, const n2k::Frame& frame) {
  const Result<n2k::Identifier> identifier = n2k::parse_identifier(frame.identifier);
  if (!identifier.ok()) return false;
  if (which.source && identifier.value().source != *which.source) return false;
  if (which.pgn && identifier.value().pgn != *which.pgn) return false;
  return which.share >= 1.0 || random_.uniform_double() < which.share;
}

}  // namespace earshot::hil
