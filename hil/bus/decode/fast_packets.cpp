#include "hil/bus/decode/fast_packets.hpp"

#include <algorithm>
#include <bit>

#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::hil {

namespace {

constexpr std::size_t kFirstBytes = 6;  ///< of a message, in its first frame
constexpr std::size_t kNextBytes = 7;
constexpr unsigned kFrameNumber = 0x1F;  ///< the bits of byte 0 that hold it
constexpr int kSwapped = 2;              ///< so many frames ahead of the first are its own, whatever their order
/// Within a message frames come milliseconds apart; messages of one sequence are a tenth of a second or more.
constexpr Duration kLatest = Duration::milliseconds(50);

unsigned number_of(const n2k::Frame& frame) {
  return frame.data[0] & kFrameNumber;
}

std::uint8_t sequence_of(const n2k::Frame& frame) {
  return static_cast<std::uint8_t>(frame.data[0] >> 5U);
}

std::size_t frames_of(std::size_t size) {
  return size <= kFirstBytes ? 1 : 1 + (size - kFirstBytes + kNextBytes - 1) / kNextBytes;
}

/// All frames of a message of that size.
std::uint32_t all_of(std::size_t size) {
  return ~std::uint32_t{0} >> (32U - frames_of(size));
}

}  // namespace

std::optional<FastPackets::Whole> FastPackets::accept(const n2k::Identifier& identifier, const n2k::Frame& frame, std::optional<Time> now) {
  ++turn_;
  const unsigned number = frame.size < 2 ? 0 : number_of(frame);
  const bool is_of_a_message = frame.size >= 2 && (number > 0 || (frame.data[1] > 0 && frame.data[1] <= n2k::kMaxMessageSize));
  if (!is_of_a_message) {
    ++given_up_;
    return std::nullopt;
  }
  Begun& begun = begun_of(identifier, sequence_of(frame));
  const bool is_in_time = !begun.fed || !now || lies_within(*begun.fed, *now, n2k::kFastPacketTimeout);
  if (number > 0 && is_in_time && frame == begun.last) return std::nullopt;
  if (!is_in_time) give_up(begun);
  make_way(begun, number, frame, now);
  if (number == 0) {
    begun.ahead = begun.held;
    begun.first_came = now;
  }
  begun.is_in_order = begun.held == 0 || (begun.is_in_order && number > begun.last_number);
  begun.last_number = number;
  begun.frames.at(number) = frame;
  begun.held |= 1U << number;
  begun.last = frame;
  begun.fed = now;
  begun.turn = turn_;
  return (begun.held & 1U) != 0 && begun.held == all_of(begun.size) ? finish(begun) : std::nullopt;
}

bool FastPackets::is_of_the_one_before(const Begun& begun, std::optional<Time> now) {
  if (std::popcount(begun.held) <= kSwapped) return false;
  if (!begun.fed || !now || !lies_within(*begun.fed, *now, kLatest)) return true;
  return begun.is_in_order && begun.last_number + 1 == frames_of(begun.size);
}

void FastPackets::make_way(Begun& begun, unsigned number, const n2k::Frame& frame, std::optional<Time> now) {
  const bool has_first = (begun.held & 1U) != 0;
  const std::uint32_t bit = std::uint32_t{1} << number;
  if (has_first && (begun.ahead & bit) != 0) give_up_ahead(begun);
  if ((begun.held & bit) != 0 || (has_first && number >= frames_of(begun.size))) give_up(begun);
  if (number == 0) {
    begun.size = frame.data[1];
    if ((begun.held & ~all_of(begun.size)) != 0 || is_of_the_one_before(begun, now)) give_up(begun);
  }
  if (begun.held == 0) begun.began = now;
}

std::optional<FastPackets::Whole> FastPackets::finish(Begun& begun) {
  Whole whole{.bytes = {}, .began = begun.began};
  for (std::size_t i = 0; i < frames_of(begun.size); ++i) {
    const n2k::Frame& frame = begun.frames.at(i);
    const std::size_t first = i == 0 ? 2 : 1;
    const std::size_t wanted = std::min(i == 0 ? kFirstBytes : kNextBytes, begun.size - whole.bytes.size());
    if (frame.size < first + wanted) {
      give_up(begun);
      return std::nullopt;
    }
    const auto from = frame.data.begin() + static_cast<std::ptrdiff_t>(first);
    whole.bytes.insert(whole.bytes.end(), from, from + static_cast<std::ptrdiff_t>(wanted));
  }
  begun.held = 0;
  return whole;
}

void FastPackets::give_up_ahead(Begun& begun) {
  ++given_up_;
  begun.held &= ~begun.ahead;
  begun.ahead = 0;
  begun.began = begun.first_came;
}

void FastPackets::give_up(Begun& begun) {
  if (begun.held != 0) ++given_up_;
  begun.held = 0;
}

bool FastPackets::expects(const n2k::Identifier& identifier, const n2k::Frame& frame) const {
  const Begun* const begun = frame.size == 0 ? nullptr : find(identifier, sequence_of(frame));
  if (begun == nullptr || (begun->held & 1U) == 0) return false;
  const unsigned number = number_of(frame);
  return number < frames_of(begun->size) && (begun->held >> number & 1U) == 0;
}

std::uint64_t FastPackets::incomplete() const {
  return given_up_ + static_cast<std::uint64_t>(std::ranges::count_if(begun_, [](const Begun& begun) { return begun.held != 0; }));
}

const FastPackets::Begun* FastPackets::find(const n2k::Identifier& identifier, std::uint8_t sequence) const {
  const auto found = std::ranges::find_if(begun_, [&](const Begun& begun) {
    return begun.pgn == identifier.pgn && begun.destination == identifier.destination && begun.sequence == sequence;
  });
  return found == begun_.end() ? nullptr : &*found;
}

FastPackets::Begun& FastPackets::begun_of(const n2k::Identifier& identifier, std::uint8_t sequence) {
  if (const Begun* const found = find(identifier, sequence)) return begun_[static_cast<std::size_t>(found - begun_.data())];
  Begun fresh{.pgn = identifier.pgn, .destination = identifier.destination, .sequence = sequence};
  if (begun_.size() < kMostBegun) return begun_.emplace_back(fresh);
  const auto is_older = [](const Begun& a, const Begun& b) { return a.turn < b.turn; };
  Begun& oldest = *std::ranges::min_element(begun_, is_older);
  give_up(oldest);
  return oldest = fresh;
}

}  // namespace earshot::hil
