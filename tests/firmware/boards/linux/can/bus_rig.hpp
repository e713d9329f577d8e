#pragma once

#include <gtest/gtest.h>
#include <net/if.h>
#include <poll.h>

#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "firmware/boards/linux/can/can_port.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"

namespace earshot::board {

inline constexpr const char* kInterface = "vcan0";
inline constexpr std::uint8_t kOwn = 0x40;        ///< the address that a port claims unless told otherwise
inline constexpr std::uint8_t kCommander = 0x55;  ///< of the device in the test's hand

/// A host's clocks in the test's hand.
class SetHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return Time{1'795'000'000'000'000} + passed; }
  [[nodiscard]] Duration monotonic() const override { return Duration::seconds(5000) + passed; }
  Duration passed;
};

/// Remembers what a port brings.
class Taken final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& value) override { values.push_back(value); }
  void report_trouble(std::uint8_t /*port*/, BusTrouble trouble, bool is_there) override {
    troubles.set(static_cast<std::size_t>(trouble), is_there);
  }
  void report_order_trouble(std::uint8_t /*port*/, OrderTrouble trouble) override { order_troubles.push_back(trouble); }
  [[nodiscard]] bool has(BusTrouble trouble) const { return troubles[static_cast<std::size_t>(trouble)]; }
  template <class Message>
  [[nodiscard]] std::vector<Message> all() const {
    std::vector<Message> found;
    for (const Value& value : values) {
      if (const auto* message = std::get_if<Message>(&value)) found.push_back(*message);
    }
    return found;
  }
  std::vector<Value> values;
  BusTroubles troubles;  ///< that the port says are there
  std::vector<OrderTrouble> order_troubles;
};

/// A message that was on the bus, its frames put together.
struct Heard {
  n2k::Identifier identifier;
  std::vector<std::uint8_t> bytes;
};

/// A CAN port on vcan0, and a socket of the test's on the same bus. Run by hil/bus/with-can, which makes it and sets CAN_REQUIRED=1.
class BusRig : public testing::Test {
 protected:
  static constexpr std::uint8_t kPort = 1;

  void SetUp() override {
    if (::if_nametoindex(kInterface) == 0) {
      const char* required = std::getenv("CAN_REQUIRED");
      ASSERT_FALSE(required != nullptr && std::string(required) == "1") << "CAN_REQUIRED=1, but there is no " << kInterface;
      GTEST_SKIP() << "no interface " << kInterface << ": run me with hil/bus/with-can";
    }
    settings_ = {.name = "vehicle", .kind = host::PortKind::kCan, .address = kInterface, .roles = host::kCanRoles};
    // Frames are dated by the kernel's clock: on a busy machine seconds may pass between two that a test sends one after the other.
    settings_.n2k.navigation.oldest_part = Duration::seconds(300);
    join(kInterface);
  }

  /// The test's own sockets. What one of them hears the port has been given, too: frames are on their way for a while.
  void join(const char* interface) {
    bus_.emplace(interface);
    witness_.emplace(interface);
  }

  /// With the settings as they are; it has no address yet.
  void open() { port_ = std::make_unique<CanPort>(kPort, settings_, plane(), host_, host::IfMissing::kKeepTrying); }
  /// With an address, and after what it says of itself then.
  void open_settled() {
    open();
    serve_for(Duration::milliseconds(1000));
    ASSERT_TRUE(port_->settle());
    (void)heard();
  }
  static n2k::LocalPlane plane() { return n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value(); }

  /// Time passes on the host in steps of a tenth of a second; the port reads and is served as the loop does.
  void serve_for(Duration time) {
    for (Duration left = time; left > Duration{}; left = left - Duration::milliseconds(100)) {
      port_->serve();
      host_.passed = host_.passed + Duration::milliseconds(100);
      collect();
    }
    port_->serve();
  }
  void collect() { port_->collect(clock_, taken_); }

  void send(const n2k::Frame& frame) {
    ASSERT_EQ(bus_->send(frame), Status::kOk);
    ASSERT_TRUE(wait_for(*witness_, frame.identifier));
  }
  /// Reads until a frame of this identifier has come. @return false when it has not in five seconds
  static bool wait_for(host::CanSocket& socket, std::uint32_t identifier) {
    for (pollfd ready{socket.file_descriptor(), POLLIN, 0}; ::poll(&ready, 1, 5000) == 1;) {
      for (n2k::Frame frame; socket.receive(frame) == Status::kOk;) {
        if (frame.identifier == identifier) return true;
      }
    }
    return false;
  }
  template <class Frames>
  void send_all(const Frames& frames) {
    for (const n2k::Frame& frame : frames) send(frame);
  }
  /// The frame 18EEFFss of a device.
  void claim(n2k::Name name, std::uint8_t address) {
    n2k::Frame frame{.identifier = 0x18EE'FF00U | address};
    for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
    send(frame);
  }
  /// The frame 18EAddss: asks for a group.
  void request(std::uint32_t pgn, std::uint8_t destination = n2k::kBroadcast) {
    n2k::Frame frame{.identifier = 0x18EA'0000U | (std::uint32_t{destination} << 8U) | kCommander, .size = 3};
    for (unsigned i = 0; i < 3; ++i) frame.data[i] = static_cast<std::uint8_t>(pgn >> (8 * i));
    send(frame);
  }
  void order(messages::Order order, std::uint32_t number, std::uint8_t destination = kOwn) {
    n2k::FastPacketFrames frames;
    const messages::OperatorCommand command{
        .time = clock_.time, .expiry = clock_.time + Duration::seconds(10), .issuer = 4711, .number = number, .order = order};
    ASSERT_EQ(n2k::compose_command(command, {.source = kCommander, .destination = destination, .sequence = sequence_++}, frames),
              Status::kOk);
    send_all(frames);
  }

  /// What the port has sent since this was last asked.
  std::vector<Heard> heard() {
    std::vector<Heard> messages;
    constexpr n2k::Frame kMark{.identifier = 0x1DFF'FF99};  // of a group that nobody has: what the port said came before
    EXPECT_EQ(witness_->send(kMark), Status::kOk);
    for (n2k::Frame frame; next(frame) && frame.identifier != kMark.identifier;) {
      const n2k::Identifier identifier = n2k::parse_identifier(frame.identifier).value();
      std::span<const std::uint8_t> bytes = frame.bytes();
      const n2k::Message* message = n2k::find_message(identifier.pgn);
      const bool is_fast = identifier.pgn == n2k::kPeerPgn || (message != nullptr && message->framing == n2k::Framing::kFast);
      if (is_fast && assembly_.accept(identifier, frame, bytes) != Status::kOk) continue;
      messages.push_back({.identifier = identifier, .bytes = {bytes.begin(), bytes.end()}});
    }
    return messages;
  }
  std::vector<Heard> heard(std::uint32_t pgn) {
    std::vector<Heard> messages = heard();
    std::erase_if(messages, [pgn](const Heard& message) { return message.identifier.pgn != pgn; });
    return messages;
  }

  bool next(n2k::Frame& frame) {
    for (pollfd ready{bus_->file_descriptor(), POLLIN, 0}; bus_->receive(frame) != Status::kOk;) {
      if (::poll(&ready, 1, 5000) != 1) return false;
    }
    return true;
  }

  SetHost host_;
  SetClock clock_;
  host::PortSettings settings_;
  std::optional<host::CanSocket> bus_;
  std::optional<host::CanSocket> witness_;
  std::unique_ptr<CanPort> port_;
  Taken taken_;
  n2k::FastPacketAssembly assembly_;
  std::uint8_t sequence_ = 0;
};

}  // namespace earshot::board
