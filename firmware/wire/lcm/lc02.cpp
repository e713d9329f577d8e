#include "firmware/wire/lcm/lc02.hpp"

#include <algorithm>

namespace earshot::wire {

namespace {

std::uint16_t read_u16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>((unsigned{bytes[at]} << 8U) | bytes[at + 1]);
}

std::uint32_t read_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return (std::uint32_t{read_u16(bytes, at)} << 16U) | read_u16(bytes, at + 2);
}

/// Appends to the head of a datagram, which has room for the longest.
struct HeadWriter {
  Datagram& datagram;

  void byte(std::uint8_t value) { datagram.head[datagram.head_size++] = value; }
  void u16(std::uint32_t value) {
    byte(static_cast<std::uint8_t>(value >> 8U));
    byte(static_cast<std::uint8_t>(value));
  }
  void u32(std::uint32_t value) {
    u16(value >> 16U);
    u16(value & 0xFFFFU);
  }
  void channel(std::string_view name) {
    for (const char c : name) byte(static_cast<std::uint8_t>(c));
    byte(0);
  }
};

/// The channel at the beginning of `payload`; empty if it does not end within its allowed length.
std::string_view read_channel(std::span<const std::uint8_t> payload) {
  const std::size_t limit = std::min(payload.size(), kMaxChannelLength + 1);
  for (std::size_t i = 0; i < limit; ++i) {
    if (payload[i] == 0) return {reinterpret_cast<const char*>(payload.data()), i};
  }
  return {};
}

std::size_t payload_size(const Lc02Message& message) {
  return message.channel.size() + 1 + message.data.size();
}

}  // namespace

std::size_t datagram_count(const Lc02Message& message) {
  const bool named =
      !message.channel.empty() && message.channel.size() <= kMaxChannelLength && message.channel.find('\0') == std::string_view::npos;
  if (!named || message.data.size() > config::kLcmMessageBytes) return 0;
  const std::size_t payload = payload_size(message);
  return payload <= kMaxShortPayload ? 1 : (payload + kMaxFragmentPayload - 1) / kMaxFragmentPayload;
}

Status compose(const Lc02Message& message, std::uint32_t sequence_number, std::size_t index, Datagram& datagram) {
  const std::size_t count = datagram_count(message);
  if (index >= count) return Status::kOutOfRange;
  datagram.head_size = 0;
  HeadWriter head{datagram};
  if (count == 1) {
    head.u32(kShortMagic);
    head.u32(sequence_number);
    head.channel(message.channel);
    datagram.data = message.data;
    return Status::kOk;
  }
  const std::size_t channel_bytes = message.channel.size() + 1;
  const std::size_t begin = index == 0 ? 0 : index * kMaxFragmentPayload - channel_bytes;
  const std::size_t end = std::min(message.data.size(), (index + 1) * kMaxFragmentPayload - channel_bytes);
  head.u32(kFragmentMagic);
  head.u32(sequence_number);
  head.u32(static_cast<std::uint32_t>(message.data.size()));
  head.u32(static_cast<std::uint32_t>(begin));
  head.u16(static_cast<std::uint32_t>(index));
  head.u16(static_cast<std::uint32_t>(count));
  if (index == 0) head.channel(message.channel);
  datagram.data = message.data.subspan(begin, end - begin);
  return Status::kOk;
}

/// One fragment, taken apart; its own numbers are consistent.
struct Reassembly::Fragment {
  std::uint32_t sequence_number = 0;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 0;
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

Status Reassembly::accept(std::span<const std::uint8_t> datagram, Sender sender, Lc02Message& message) {
  ++turn_;
  if (datagram.size() < kShortHeaderSize) return malformed();
  switch (read_u32(datagram, 0)) {
    case kShortMagic:
      return accept_short(datagram, message);
    case kFragmentMagic:
      return accept_fragment(datagram, sender, message);
    default:
      return malformed();
  }
}

Status Reassembly::accept_short(std::span<const std::uint8_t> datagram, Lc02Message& message) {
  const auto payload = datagram.subspan(kShortHeaderSize);
  const std::string_view channel = read_channel(payload);
  if (channel.empty()) return malformed();
  message = {channel, payload.subspan(channel.size() + 1)};
  ++counters_.completed;
  return Status::kOk;
}

Status Reassembly::accept_fragment(std::span<const std::uint8_t> datagram, Sender sender, Lc02Message& message) {
  if (datagram.size() < kFragmentHeaderSize) return malformed();
  Fragment fragment{.sequence_number = read_u32(datagram, 4),
                    .size = read_u32(datagram, 8),
                    .offset = read_u32(datagram, 12),
                    .number = read_u16(datagram, 16),
                    .count = read_u16(datagram, 18),
                    .channel = {},
                    .data = datagram.subspan(kFragmentHeaderSize)};
  if (fragment.number >= fragment.count) return malformed();
  if (fragment.number == 0) {
    fragment.channel = read_channel(fragment.data);
    if (fragment.channel.empty()) return malformed();
    fragment.data = fragment.data.subspan(fragment.channel.size() + 1);
  }
  if (fragment.size > config::kLcmMessageBytes || fragment.count > kMaxFragments) {
    ++counters_.too_large;
    return Status::kFull;
  }
  if (fragment.offset > fragment.size || fragment.data.size() > fragment.size - fragment.offset) return malformed();

  Slot& slot = slot_for(fragment, sender);
  if (fragment.size != slot.size || fragment.count != slot.fragment_count) return malformed();
  Extent& extent = slot.fragments[fragment.number];
  if (extent.seen) return Status::kNotReady;
  extent = {.begin = fragment.offset, .end = fragment.offset + static_cast<std::uint32_t>(fragment.data.size()), .seen = true};
  slot.last_fed = turn_;
  ++slot.fragments_seen;
  std::ranges::copy(fragment.data, slot.data.begin() + fragment.offset);
  if (fragment.number == 0) {
    std::ranges::copy(fragment.channel, slot.channel.begin());
    slot.channel_length = fragment.channel.size();
  }
  if (slot.fragments_seen < slot.fragment_count) return Status::kNotReady;

  slot.used = false;
  if (!is_whole(slot)) return malformed();
  message = {{slot.channel.data(), slot.channel_length}, {slot.data.data(), slot.size}};
  ++counters_.completed;
  return Status::kOk;
}

/// Whether the fragments follow one another without hole or overlap; if not, their offsets lied.
bool Reassembly::is_whole(const Slot& slot) {
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < slot.fragment_count; ++i) {
    if (slot.fragments[i].begin != at) return false;
    at = slot.fragments[i].end;
  }
  return at == slot.size;
}

Reassembly::Slot& Reassembly::slot_for(const Fragment& fragment, Sender sender) {
  for (Slot& slot : slots_) {
    if (slot.used && slot.sender == sender && slot.sequence_number == fragment.sequence_number) return slot;
  }
  Slot* chosen = &slots_[0];
  for (Slot& slot : slots_) {
    if (!slot.used) {
      chosen = &slot;
      break;
    }
    if (slot.last_fed < chosen->last_fed) chosen = &slot;
  }
  if (chosen->used) ++counters_.incomplete;
  chosen->used = true;
  chosen->sender = sender;
  chosen->sequence_number = fragment.sequence_number;
  chosen->size = fragment.size;
  chosen->fragment_count = fragment.count;
  chosen->fragments_seen = 0;
  chosen->last_fed = turn_;
  chosen->channel_length = 0;
  chosen->fragments.fill(Extent{});
  return *chosen;
}

Status Reassembly::malformed() {
  ++counters_.malformed;
  return Status::kMalformed;
}

}  // namespace earshot::wire
