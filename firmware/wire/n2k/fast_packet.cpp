#include "firmware/wire/n2k/fast_packet.hpp"

#include <algorithm>

namespace earshot::n2k {

namespace {

constexpr std::size_t kFirstFrameBytes = 6;
constexpr std::size_t kNextFrameBytes = 7;
constexpr unsigned kFrameNumber = 0x1F;  ///< the bits of byte 0 that hold it

/// Copies what of `bytes` still has to go into `frame` from its byte `at` on, and pads with 0xFF; returns the rest.
std::span<const std::uint8_t> fill(Frame& frame, std::size_t at, std::span<const std::uint8_t> bytes) {
  frame.size = 8;
  const std::size_t count = std::min(bytes.size(), frame.data.size() - at);
  std::ranges::fill(std::ranges::copy(bytes.first(count), frame.data.begin() + static_cast<std::ptrdiff_t>(at)).out, frame.data.end(),
                    std::uint8_t{0xFF});
  return bytes.subspan(count);
}

}  // namespace

Status compose_fast_packet(const Identifier& identifier, std::uint8_t sequence, std::span<const std::uint8_t> bytes,
                           FastPacketFrames& frames) {
  const Result<std::uint32_t> can_identifier = compose(identifier);
  if (!can_identifier.ok() || bytes.empty() || bytes.size() > kMaxMessageSize) return Status::kOutOfRange;
  frames.clear();
  const unsigned sequence_bits = (sequence & 7U) << 5U;
  Frame frame{.identifier = can_identifier.value()};
  frame.data[0] = static_cast<std::uint8_t>(sequence_bits);
  frame.data[1] = static_cast<std::uint8_t>(bytes.size());
  auto rest = fill(frame, 2, bytes);
  Status status = frames.push_back(frame);
  for (unsigned number = 1; !rest.empty() && status == Status::kOk; ++number) {
    frame.data[0] = static_cast<std::uint8_t>(sequence_bits | number);
    rest = fill(frame, 1, rest);
    status = frames.push_back(frame);
  }
  return status;
}

Status FastPacketAssembly::accept(const Identifier& identifier, const Frame& frame, std::span<const std::uint8_t>& bytes) {
  Assembled message;
  const Status status = accept(identifier, frame, Time{}, message);
  bytes = message.bytes;
  return status;
}

Status FastPacketAssembly::accept(const Identifier& identifier, const Frame& frame, Time now, Assembled& message) {
  ++turn_;
  if (frame.size != 8) {
    ++counters_.stray;
    return Status::kMalformed;
  }
  if ((frame.data[0] & kFrameNumber) == 0) return begin(identifier, frame, now, message);
  const Slot* found = find(identifier);
  if (found == nullptr) {
    ++counters_.stray;
    return Status::kMalformed;
  }
  return go_on(slots_[static_cast<std::size_t>(found - slots_.data())], frame, now, message);
}

Status FastPacketAssembly::begin(const Identifier& identifier, const Frame& frame, Time now, Assembled& message) {
  const std::size_t size = frame.data[1];
  if (size == 0 || size > kMaxMessageSize) {
    ++counters_.too_large;
    if (const Slot* under_way = find(identifier)) {
      slots_[static_cast<std::size_t>(under_way - slots_.data())].used = false;
      ++counters_.abandoned;
    }
    return Status::kFull;
  }
  Slot& slot = slot_for(identifier);
  if (slot.used) ++counters_.abandoned;
  slot.used = true;
  slot.identifier = identifier;
  slot.sequence = static_cast<std::uint8_t>(frame.data[0] >> 5U);
  slot.next_frame = 1;
  slot.size = size;
  slot.filled = std::min(kFirstFrameBytes, size);
  slot.last_fed = turn_;
  slot.began = now;
  slot.fed = now;
  std::copy_n(frame.data.begin() + 2, slot.filled, slot.bytes.begin());
  return finish(slot, message);
}

Status FastPacketAssembly::go_on(Slot& slot, const Frame& frame, Time now, Assembled& message) {
  const unsigned number = frame.data[0] & kFrameNumber;
  const bool same_message = (frame.data[0] >> 5U) == slot.sequence && lies_within(slot.fed, now, kFastPacketTimeout);
  if (same_message && number + 1 == slot.next_frame &&
      std::equal(frame.data.begin() + 1, frame.data.end(),
                 slot.bytes.begin() + static_cast<std::ptrdiff_t>(slot.filled - kNextFrameBytes))) {
    ++counters_.repeated;
    return Status::kNotReady;
  }
  if (!same_message || number != slot.next_frame) {
    slot.used = false;
    ++counters_.abandoned;
    return Status::kMalformed;
  }
  const std::size_t count = std::min(kNextFrameBytes, slot.size - slot.filled);
  std::copy_n(frame.data.begin() + 1, count, slot.bytes.begin() + static_cast<std::ptrdiff_t>(slot.filled));
  slot.filled += count;
  slot.last_fed = turn_;
  slot.fed = now;
  ++slot.next_frame;
  return finish(slot, message);
}

Status FastPacketAssembly::finish(Slot& slot, Assembled& message) {
  if (slot.filled < slot.size) return Status::kNotReady;
  slot.used = false;
  ++counters_.completed;
  message = {.bytes = {slot.bytes.data(), slot.size}, .began = slot.began};
  return Status::kOk;
}

bool FastPacketAssembly::expects(const Identifier& identifier, const Frame& frame) const {
  const Slot* slot = find(identifier);
  return slot != nullptr && (frame.data[0] & kFrameNumber) == slot->next_frame && (frame.data[0] >> 5U) == slot->sequence;
}

const FastPacketAssembly::Slot* FastPacketAssembly::find(const Identifier& identifier) const {
  for (const Slot& slot : slots_) {
    const Identifier& other = slot.identifier;
    if (slot.used && other.pgn == identifier.pgn && other.source == identifier.source && other.destination == identifier.destination)
      return &slot;
  }
  return nullptr;
}

FastPacketAssembly::Slot& FastPacketAssembly::slot_for(const Identifier& identifier) {
  if (const Slot* slot = find(identifier)) return slots_[static_cast<std::size_t>(slot - slots_.data())];
  Slot* chosen = &slots_[0];
  for (Slot& slot : slots_) {
    if (!slot.used) return slot;
    if (slot.last_fed < chosen->last_fed) chosen = &slot;
  }
  return *chosen;
}

}  // namespace earshot::n2k
