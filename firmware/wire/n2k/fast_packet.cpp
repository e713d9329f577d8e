#include "firmware/wire/n2k/fast_packet.hpp"

#include <algorithm>

namespace earshot::n2k {

namespace {

constexpr std::size_t kFirstFrameBytes = 6;
constexpr std::size_t kNextFrameBytes = 7;
constexpr std::size_t kSmallestFastPacket = 9;  ///< bytes; anything shorter goes in one frame

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
  if (!can_identifier.ok() || bytes.size() < kSmallestFastPacket || bytes.size() > kMaxMessageSize) return Status::kOutOfRange;
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
  ++turn_;
  if (frame.size != 8) {
    ++counters_.stray;
    return Status::kMalformed;
  }
  const auto number = static_cast<std::uint8_t>(frame.data[0] & 0x1FU);
  if (number == 0) return begin(identifier, frame);

  Slot* slot = find(identifier);
  if (slot == nullptr) {
    ++counters_.stray;
    return Status::kMalformed;
  }
  if (number != slot->next_frame || (frame.data[0] >> 5U) != slot->sequence) {
    slot->used = false;
    ++counters_.abandoned;
    return Status::kMalformed;
  }
  const std::size_t count = std::min(kNextFrameBytes, slot->size - slot->filled);
  std::copy_n(frame.data.begin() + 1, count, slot->bytes.begin() + static_cast<std::ptrdiff_t>(slot->filled));
  slot->filled += count;
  slot->last_fed = turn_;
  ++slot->next_frame;
  if (slot->filled < slot->size) return Status::kNotReady;
  slot->used = false;
  ++counters_.completed;
  bytes = {slot->bytes.data(), slot->size};
  return Status::kOk;
}

Status FastPacketAssembly::begin(const Identifier& identifier, const Frame& frame) {
  const std::size_t size = frame.data[1];
  if (size < kSmallestFastPacket || size > kMaxMessageSize) {
    ++counters_.too_large;
    return Status::kFull;
  }
  Slot& slot = slot_for(identifier);
  if (slot.used) ++counters_.abandoned;
  slot.used = true;
  slot.identifier = identifier;
  slot.sequence = static_cast<std::uint8_t>(frame.data[0] >> 5U);
  slot.next_frame = 1;
  slot.size = size;
  slot.filled = kFirstFrameBytes;
  slot.last_fed = turn_;
  std::copy_n(frame.data.begin() + 2, kFirstFrameBytes, slot.bytes.begin());
  return Status::kNotReady;
}

FastPacketAssembly::Slot* FastPacketAssembly::find(const Identifier& identifier) {
  for (Slot& slot : slots_) {
    const Identifier& other = slot.identifier;
    if (slot.used && other.pgn == identifier.pgn && other.source == identifier.source && other.destination == identifier.destination)
      return &slot;
  }
  return nullptr;
}

FastPacketAssembly::Slot& FastPacketAssembly::slot_for(const Identifier& identifier) {
  if (Slot* slot = find(identifier)) return *slot;
  Slot* chosen = &slots_[0];
  for (Slot& slot : slots_) {
    if (!slot.used) return slot;
    if (slot.last_fed < chosen->last_fed) chosen = &slot;
  }
  return *chosen;
}

}  // namespace earshot::n2k
