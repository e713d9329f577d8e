#include "firmware/wire/n2k/node/commanded_address.hpp"

#include <algorithm>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

namespace {

constexpr std::uint8_t kBroadcastAnnouncement = 32;
constexpr std::uint8_t kPackets = 2;
constexpr std::size_t kBytesPerPacket = 7;
constexpr Duration kBetweenPackets = Duration::milliseconds(750);

/// 9 bytes in 2 packets of group 65240 = 0x00FED8.
constexpr std::array<std::uint8_t, 8> kAnnouncement{
    kBroadcastAnnouncement, table::kCommandedAddress.size, 0, kPackets, 0xFF, 0xD8, 0xFE, 0};

}  // namespace

std::optional<AddressCommand> CommandedAddress::accept(const Identifier& identifier, const Frame& frame, Time now) {
  if (identifier.pgn == kTransportControlPgn) {
    const bool announced = frame.size == 8 && frame.data == kAnnouncement && identifier.destination == kBroadcast;
    if (announced) {
      sender_ = identifier.source;
      next_ = 1;
      last_ = now;
    } else if (sender_ == identifier.source) {
      sender_.reset();
    }
    return std::nullopt;
  }
  if (identifier.pgn != kTransportDataPgn || sender_ != identifier.source || identifier.destination != kBroadcast) return std::nullopt;
  if (frame.size != 8 || frame.data[0] != next_ || !lies_within(last_, now, kBetweenPackets)) {
    sender_.reset();
    return std::nullopt;
  }
  std::copy_n(frame.data.begin() + 1, kBytesPerPacket, bytes_.begin() + static_cast<std::ptrdiff_t>(kBytesPerPacket * (next_ - 1U)));
  last_ = now;
  if (next_++ < kPackets) return std::nullopt;
  sender_.reset();
  AddressCommand command;
  for (unsigned i = 0; i < 8; ++i) command.name |= Name{bytes_[i]} << (8U * i);
  command.name = commanded_bits(command.name);
  command.address = bytes_[8];
  return command;
}

}  // namespace earshot::n2k
