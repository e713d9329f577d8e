// Random and mutated CAN frames for everything that reads them on a vehicle. See README.md of this folder.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <random>
#include <span>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/navigation.hpp"
#include "firmware/wire/n2k/node/information.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

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

constexpr double kPi = 3.141592653589793;

bool is_sound(const n2k::Fix& fix) {
  return is_finite(fix.position) && std::abs(fix.heading.value) <= kPi && std::abs(fix.depth.value) < 30'000.0 &&
         (!fix.speed || (fix.speed->value >= 0.0 && fix.speed->value < 656.0));
}

bool is_sound(const n2k::Readings& readings) {
  if (readings.heading && !(std::abs(readings.heading->value.value) <= kPi)) return false;
  if (readings.position && !(std::abs(readings.position->value.latitude_deg) <= 90.0)) return false;
  if (readings.altitude && !(readings.altitude->value.value >= 0.0)) return false;
  if (readings.rate_of_turn && !(std::abs(readings.rate_of_turn->value.value) < 68.0)) return false;
  return !readings.over_ground || readings.over_ground->value.speed.value >= 0.0;
}

/// Everything on a vehicle that reads frames.
class Readers {
 public:
  void take(std::uint64_t number, const Frame& frame, Time now) {
    n2k::Fix fix;
    if (receiver_.accept(frame, now, fix) == Status::kOk) {
      ++fixes_;
      if (!is_sound(fix) || fix.time > now) violated(number, "a fix that cannot be");
    }
    if (!is_sound(receiver_.sensors().readings())) violated(number, "a reading that cannot be");
    messages::OperatorCommand command;
    std::uint8_t sender = 0;
    if (orders_.accept(frame, now, n2k::kRuntimeAddress, command, sender) == Status::kOk) {
      ++commands_;
      if (command.order < messages::Order::kStart || command.order > messages::Order::kAbort)
        violated(number, "an order that nobody knows");
    }
    messages::Setpoint setpoint;
    if (setpoints_.accept(frame, setpoint) == Status::kOk && !(std::abs(setpoint.heading.value) <= kPi))
      violated(number, "a wild set-point");
    static_cast<void>(n2k::read_snr(frame.bytes()));
    static_cast<void>(n2k::read_leak(frame.bytes()));
    node_.accept(frame, now);
    n2k::NodeFrames frames;
    node_.step(now, frames);
    for (const Frame& sent : frames) {
      const auto identifier = n2k::parse_identifier(sent.identifier);
      if (!identifier.ok() || sent.size > 8) violated(number, "the node sends what is no frame");
      if (identifier.value().source > n2k::kLastAddress && identifier.value().source != n2k::kNullAddress)
        violated(number, "a wrong source");
    }
    sent_ += frames.size();
  }

  void print(std::uint64_t count) const {
    std::printf("%llu frames: %llu fixes, %llu commands, %llu frames sent by the node, no memory asked for\n",
                static_cast<unsigned long long>(count), static_cast<unsigned long long>(fixes_), static_cast<unsigned long long>(commands_),
                static_cast<unsigned long long>(sent_));
  }
  [[nodiscard]] bool has_seen_all() const { return fixes_ > 0 && commands_ > 0 && sent_ > 0; }

 private:
  static n2k::Identity identity() {
    n2k::Identity identity;
    identity.name = n2k::name_of({.unique_number = 1}).value();
    return identity;
  }
  n2k::NavigationReceiver receiver_{n2k::LocalPlane{}, {.sensors = {}, .oldest_part = Duration::seconds(60)}};
  n2k::OrderReceiver orders_;
  n2k::SetpointReceiver setpoints_;
  n2k::Node node_{identity(), n2k::table_pgns(n2k::PgnListKind::kTransmitted), n2k::table_pgns(n2k::PgnListKind::kReceived)};
  std::uint64_t fixes_ = 0;
  std::uint64_t commands_ = 0;
  std::uint64_t sent_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: random_frames COUNT [SEED]\n");
    return 2;
  }
  const std::uint64_t count = std::strtoull(argv[1], nullptr, 10);
  Frames frames(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0);
  Readers readers;
  Time now{1'000'000'000};
  const std::uint64_t before = allocations;
  for (std::uint64_t number = 0; number < count; ++number) {
    readers.take(number, frames.next(), now);
    now = now + Duration{static_cast<std::int64_t>(frames.number() % 4096 == 0 ? frames.number() % 40'000'000 : frames.number() % 2'000)};
    if (allocations != before) violated(number, "memory was asked for");
  }
  readers.print(count);
  return readers.has_seen_all() ? 0 : 1;
}
