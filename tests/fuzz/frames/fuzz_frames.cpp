// CAN frames that libFuzzer makes up, for everything that reads them on a vehicle. See README.md of the folder above.
//
// Its input is a row of records. The first byte of each says how much later it comes, the second what it is:
//
//   0 to 127    one frame: identifier (4 bytes, lowest first), how many bytes of data it has (1, modulo 9), data (8)
//   128 to 255  a whole message, cut into frames: which of the table's (this byte less 128, modulo), its source, its destination, its
//               sequence (1 each), then its bytes. An own message's head is laid over its first bytes by exclusive or: zeros there are
//               ours.
//
// What the input is too short for is 0xFF. frame_seeds writes such files.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "tests/fuzz/frames/frame_readers.hpp"

namespace {

using namespace earshot;

/// The bytes of an input, one after the other.
class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] bool is_used_up() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0xFF;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// To 127 ms in milliseconds, then to 64 s in half seconds: within a packet, a timeout of a sensor, the node's heartbeat.
Duration later(std::uint8_t step) {
  return step < 128 ? Duration::milliseconds(step) : Duration::milliseconds(500 * (step - 127));
}

n2k::Frame frame_in(Input& input) {
  n2k::Frame frame;
  for (unsigned i = 0; i < 4; ++i) frame.identifier |= std::uint32_t{input.byte()} << (8U * i);
  frame.size = static_cast<std::uint8_t>(input.byte() % 9);
  for (std::uint8_t& byte : frame.data) byte = input.byte();
  return frame;
}

/// Only addressed groups have a destination.
n2k::Identifier identifier_in(Input& input, const n2k::Message& message) {
  const std::uint8_t source = input.byte();
  const std::uint8_t destination = input.byte();
  const bool is_addressed = ((message.pgn >> 8U) & 0xFFU) < 240;
  return {message.pgn, message.priority, source, is_addressed ? destination : n2k::kBroadcast};
}

n2k::FastPacketFrames message_in(Input& input, const n2k::Message& message) {
  const n2k::Identifier identifier = identifier_in(input, message);
  const std::uint8_t sequence = input.byte();
  std::array<std::uint8_t, n2k::kMaxMessageSize> bytes{};
  if (n2k::find_signal(message, "IndustryGroup") != nullptr && message.signals[0].name == "ManufacturerCode")
    std::ranges::copy(n2k::begin_own(message).bytes().first(message.kind != 0 ? 3 : 2), bytes.begin());
  for (std::size_t i = 0; i < message.size; ++i) bytes[i] ^= input.byte();
  n2k::FastPacketFrames frames;
  const auto used = std::span<const std::uint8_t>(bytes).first(message.size);
  if (message.framing == n2k::Framing::kFast) {
    static_cast<void>(n2k::compose_fast_packet(identifier, sequence, used, frames));
  } else {
    n2k::Frame frame{.identifier = n2k::compose(identifier).value()};
    frame.size = std::min(message.size, frame.size);
    std::copy_n(used.begin(), frame.size, frame.data.begin());
    static_cast<void>(frames.push_back(frame));
  }
  return frames;
}

void take(fuzz::FrameReaders& readers, const n2k::Frame& frame, Time now) {
  if (const char* const wrong = readers.take(frame, now)) {
    std::fprintf(stderr, "%s\n", wrong);
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::FrameReaders readers;
  Time now{1'000'000'000};
  take(readers, {}, now);
  now = now + Duration::milliseconds(300);  // the node has its address
  take(readers, {}, now);
  for (Input input({data, size}); !input.is_used_up();) {
    now = now + later(input.byte());
    const std::uint8_t what = input.byte();
    if (what < 128) {
      take(readers, frame_in(input), now);
      continue;
    }
    for (const n2k::Frame& frame : message_in(input, n2k::messages()[(what - 128U) % n2k::messages().size()])) take(readers, frame, now);
  }
  return 0;
}
