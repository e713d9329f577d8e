// Random and mutated CAN frames for everything that reads them on a vehicle. See README.md of the folder above.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <random>
#include <span>
#include <string>

#include "firmware/host/program/run.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "tests/fuzz/frames/frame_readers.hpp"

namespace {
std::uint64_t allocations = 0;
}  // namespace

// What reads frames asks for no memory: this program counts who does.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;  // NOLINT: this is what new is made of
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);  // NOLINT
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);  // NOLINT
}

namespace {

using namespace earshot;
using n2k::Frame;

[[noreturn]] void violated(std::uint64_t number, const char* what) {
  std::printf("frame %llu: %s\n", static_cast<unsigned long long>(number), what);
  std::exit(1);  // NOLINT(concurrency-mt-unsafe): one thread
}

/// Frames of every kind: noise, known groups full of noise, known groups with one thing wrong, fast packets in order and not.
class Frames {
 public:
  explicit Frames(std::uint64_t seed) : random_(seed) {}

  Frame next() {
    if (at_ < packet_.size() && random_() % 8 != 0) return packet_[at_++];
    switch (random_() % 4) {
      case 0:
        return noise(static_cast<std::uint32_t>(random_()));
      case 1:
        return noise(identifier());
      case 2:
        return mutated();
      default:
        begin_packet();
        return packet_[at_++];
    }
  }
  std::uint64_t number() { return random_(); }

 private:
  const n2k::Message& message() { return n2k::messages()[random_() % n2k::messages().size()]; }

  std::uint32_t identifier() { return identifier_of(message()); }

  std::uint32_t identifier_of(const n2k::Message& message) {
    const bool addressed = ((message.pgn >> 8U) & 0xFFU) < 240;
    const std::array<std::uint8_t, 3> destinations{n2k::kBroadcast, n2k::kRuntimeAddress, static_cast<std::uint8_t>(random_())};
    const std::uint8_t destination = addressed ? destinations[random_() % destinations.size()] : n2k::kBroadcast;
    return n2k::compose({message.pgn, message.priority, static_cast<std::uint8_t>(random_() % 12), destination}).value();
  }

  Frame noise(std::uint32_t identifier) {
    Frame frame{.identifier = identifier, .size = static_cast<std::uint8_t>(random_() % 9)};
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_());
    return frame;
  }

  std::array<std::uint8_t, n2k::kMaxMessageSize> filled(const n2k::Message& message) {
    auto bytes = blank(message);
    for (const n2k::Signal& signal : message.signals) {
      if (signal.kind != n2k::Signal::Kind::kNumber || random_() % 8 == 0) continue;
      const auto span = static_cast<std::uint64_t>(signal.highest_raw) - static_cast<std::uint64_t>(signal.lowest_raw);
      const auto raw = static_cast<std::int64_t>(static_cast<std::uint64_t>(signal.lowest_raw) + (span == 0 ? 0 : random_() % span));
      static_cast<void>(encode_raw(signal, raw, bytes));
      // Half of all places lie in the plane about latitude and longitude zero.
      const double near_zero_deg = static_cast<double>(random_() % 1000) * 1e-3;
      if (signal.unit == "deg" && random_() % 2 == 0) static_cast<void>(encode(signal, near_zero_deg, bytes));
    }
    if (n2k::find_signal(message, "IndustryGroup") != nullptr && message.signals[0].name == "ManufacturerCode") {
      bytes[0] = 0xFC;
      bytes[1] = 0x9F;
      if (message.kind != 0) bytes[2] = message.kind;
    }
    return bytes;
  }

  Frame mutated() {
    const n2k::Message& chosen = message();
    Frame frame{.identifier = identifier_of(chosen)};
    const auto bytes = filled(chosen);
    for (std::size_t i = 0; i < frame.data.size(); ++i) frame.data[i] = bytes[i];
    if (random_() % 4 == 0) frame.data[random_() % 8] ^= static_cast<std::uint8_t>(1U << (random_() % 8));
    if (random_() % 16 == 0) frame.size = static_cast<std::uint8_t>(random_() % 9);
    return frame;
  }

  void begin_packet() {
    const n2k::Message& chosen = message();
    const auto bytes = filled(chosen);
    const std::size_t size = random_() % 8 == 0 ? 1 + random_() % n2k::kMaxMessageSize : chosen.size;
    const n2k::Identifier identifier = n2k::parse_identifier(identifier_of(chosen)).value();
    static_cast<void>(compose_fast_packet(identifier, static_cast<std::uint8_t>(random_()), std::span(bytes).first(size), packet_));
    if (random_() % 4 == 0) packet_[random_() % packet_.size()].data[random_() % 8] ^= static_cast<std::uint8_t>(1U << (random_() % 8));
    at_ = 0;
  }

  std::mt19937_64 random_;
  n2k::FastPacketFrames packet_;
  std::size_t at_ = 0;
};

int try_frames(std::uint64_t count, std::uint64_t seed) {
  Frames frames(seed);
  fuzz::FrameReaders readers;
  Time now{1'000'000'000};
  const std::uint64_t before = allocations;
  for (std::uint64_t number = 0; number < count; ++number) {
    if (const char* const wrong = readers.take(frames.next(), now)) violated(number, wrong);
    now = now + Duration{static_cast<std::int64_t>(frames.number() % 4096 == 0 ? frames.number() % 40'000'000 : frames.number() % 2'000)};
    if (allocations != before) violated(number, "memory was asked for");
  }
  std::printf("%s frames: %s, no memory asked for\n", std::to_string(count).c_str(), readers.account().c_str());
  return readers.has_seen_all() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::int64_t kMost = 1'000'000'000'000;
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  program::CommandLine line("random_frames",
                            "random_frames gives CAN frames to everything that reads them on a vehicle: nothing impossible may come of\n"
                            "them, and nobody may ask for memory.\n"
                            "Exit status: 0 nothing did; 1 something did, or too few frames were tried to meet every kind.");
  line.option("COUNT", &count, "how many frames").required().from(1, kMost);
  line.option("SEED", &seed, "which frames").from(0, kMost).shows_default();
  return program::run(line, argc, argv, [&] { return try_frames(count, seed); });
}
