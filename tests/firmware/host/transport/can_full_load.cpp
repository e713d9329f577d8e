// A full bus of 1 Mbit/s, 8000 frames a second, and a socket that reads one group of it as a port does: whatever its filter lets through it
// has received, or it tells that the kernel lost it. Every such frame bears a number, so that a gap is seen; and the interface's own count
// says that all of them were on the bus. Run by hil/bus/with-can, on a vcan0 that nobody else uses.
//   can_full_load [SECONDS [SHARE]]     60 s unless told; one frame of SHARE passes the filter (8 unless told, 1: all do)
// Exit status: 0 the counts balance, 1 they do not, 2 something else on the bus or in the kernel spoilt the measurement.

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>

#include "firmware/config/capacities.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace {

using namespace earshot;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr const char* kInterface = "vcan0";
constexpr int kFramesPerPortion =
    80;  // every 10 ms: what user-mode Linux's timer of 100 Hz can do, and far below the kernel's backlog of 1000
constexpr auto kPortion = 10ms;
constexpr std::uint32_t kHeadingIdentifier = 0x09F112CC;  // 127250 from 204
constexpr std::uint32_t kRudderIdentifier = 0x09F10DCC;   // 127245 from 204

struct Sent {
  std::uint64_t frames = 0;
  std::uint64_t passing = 0;  ///< of these, such as the filter lets through
  std::uint64_t refused = 0;  ///< the kernel had no room
};

n2k::Frame numbered(std::uint32_t identifier, std::uint64_t number) {
  n2k::Frame frame{.identifier = identifier, .size = 8, .data = {}};
  std::memcpy(frame.data.data(), &number, sizeof number);
  return frame;
}

Sent send_for(std::chrono::seconds time, unsigned share) {
  host::CanSocket bus(kInterface);
  Sent sent;
  auto next = Clock::now();
  for (const auto end = next + time; next < end; std::this_thread::sleep_until(next)) {
    for (int i = 0; i < kFramesPerPortion; ++i) {
      const bool is_passing = sent.frames % share == 0;
      const Status status = bus.send(is_passing ? numbered(kHeadingIdentifier, sent.passing) : numbered(kRudderIdentifier, sent.frames));
      sent.refused += status == Status::kOk ? 0U : 1U;
      sent.frames += status == Status::kOk ? 1U : 0U;
      sent.passing += status == Status::kOk && is_passing ? 1U : 0U;
    }
    next += kPortion;
  }
  return sent;
}

/// Frames that the interface has received so far, as the kernel counts them.
std::uint64_t received_by_interface() {
  std::ifstream table("/proc/self/net/dev");
  for (std::string line; std::getline(table, line);) {
    unsigned long long bytes = 0;
    unsigned long long frames = 0;
    const std::size_t name = line.find("vcan0:");
    if (name != std::string::npos && std::sscanf(line.c_str() + name, "vcan0: %llu %llu", &bytes, &frames) == 2) return frames;
  }
  throw std::runtime_error("no vcan0: run me with hil/bus/with-can");
}

/// Packets that the kernel's backlog has dropped before any socket could count them, of all interfaces.
std::uint64_t dropped_by_backlog() {
  std::ifstream table("/proc/net/softnet_stat");
  std::uint64_t sum = 0;
  for (std::string line; std::getline(table, line);) {
    unsigned processed = 0;
    unsigned dropped = 0;
    if (std::sscanf(line.c_str(), "%x %x", &processed, &dropped) == 2) sum += dropped;
  }
  return sum;
}

/// Reads as the port of a vehicle does: sleeps until there is something, then takes what is there.
class Reader {
 public:
  Reader() : bus_(kInterface, host::IfMissing::kRefuse, options()) {}

  /// @return false after `silence` without a frame
  bool reads(std::chrono::milliseconds silence) {
    pollfd ready{bus_.file_descriptor(), POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(silence.count())) != 1) return false;
    std::size_t budget = config::kCanFramesPerCollect;
    Time arrival;
    for (n2k::Frame frame; bus_.receive(frame, arrival, budget) == Status::kOk;) {
      std::uint64_t number = 0;
      std::memcpy(&number, frame.data.data(), sizeof number);
      missing_ += number - expected_;
      expected_ = number + 1;
    }
    return true;
  }
  /// Frames of which the numbers say that they never came.
  [[nodiscard]] std::uint64_t missing(std::uint64_t sent) const { return missing_ + sent - expected_; }
  [[nodiscard]] host::CanCounters counters() const { return bus_.counters(); }
  [[nodiscard]] std::size_t room_frames() const { return bus_.room_frames(); }

 private:
  static host::CanOptions options() {
    host::CanOptions options;
    if (host::filters_for(std::array<std::uint32_t, 1>{n2k::kHeadingPgn}, options.filters) != Status::kOk)
      throw std::logic_error("no filter for headings");
    return options;
  }
  host::CanSocket bus_;
  std::uint64_t expected_ = 0;
  std::uint64_t missing_ = 0;
};

int measure(std::chrono::seconds time, unsigned share) {
  const std::uint64_t on_interface = received_by_interface();
  const std::uint64_t dropped = dropped_by_backlog();
  Reader reader;
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t sender = ::fork();
  if (sender == 0) {
    const Sent sent = send_for(time, share);
    std::_Exit(::write(pipe[1], &sent, sizeof sent) == sizeof sent ? 0 : 1);
  }
  while (::waitpid(sender, nullptr, WNOHANG) == 0) (void)reader.reads(100ms);
  while (reader.reads(500ms)) {
  }
  Sent sent;
  if (::read(pipe[0], &sent, sizeof sent) != sizeof sent) throw std::runtime_error("the sender ended without a count");
  const host::CanCounters told = reader.counters();
  const std::uint64_t seen = received_by_interface() - on_interface;
  const std::uint64_t spoilt = dropped_by_backlog() - dropped;
  const bool is_balanced = sent.passing == told.received + told.lost_by_kernel && reader.missing(sent.passing) == told.lost_by_kernel;
  std::cout << time.count() << " s: " << sent.frames << " frames sent (" << sent.refused << " refused), " << seen
            << " counted by the interface, " << spoilt << " dropped by the kernel's backlog; " << sent.passing
            << " pass the filter: " << told.received << " received, " << told.lost_by_kernel << " told as lost, "
            << reader.missing(sent.passing) << " missing by their numbers; room for " << reader.room_frames()
            << " frames: " << (is_balanced ? "none is lost silently\n" : "A FRAME IS LOST SILENTLY\n");
  if (spoilt != 0 || seen != sent.frames || sent.refused != 0) return 2;
  return is_balanced ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const int seconds = argc > 1 ? std::atoi(argv[1]) : 60;
  const int share = argc > 2 ? std::atoi(argv[2]) : 8;
  if (seconds < 1 || share < 1) throw std::runtime_error("can_full_load [SECONDS [SHARE]]: whole numbers from 1");
  return measure(std::chrono::seconds(seconds), static_cast<unsigned>(share));
} catch (const std::exception& e) {
  std::cerr << "can_full_load: " << e.what() << "\n";
  return 2;
}
