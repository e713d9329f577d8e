// Peer of sil.times_real_time: the same messages between two processes in the same lock-step, and nothing else: no vehicle, policy, journal
// or track. With the argument "busy", peer of sil.busy.times_real_time: beside eight busy loops on two processors.

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "sim/link/run_slot.hpp"
#include "sim/link/runtime_end.hpp"
#include "sim/link/simulator_end.hpp"
#include "tests/bench/busy_loops.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/support/lcm_peer.hpp"

namespace {

using namespace earshot;
using namespace std::chrono_literals;

constexpr std::uint64_t kTicks = 50'000;
constexpr std::uint64_t kTicksWhenBusy = 5'000;

/// Until one message on `channel` has come. @throws std::runtime_error: none has in ten seconds
void take_one(host::LcmEndpoint& bus, std::string_view channel) {
  for (const auto end = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < end;) {
    bus.collect();
    for (wire::Lc02Message message; bus.take(message) == Status::kOk;) {
      if (message.channel == channel) return;
    }
    pollfd readable{.fd = bus.file_descriptor(), .events = POLLIN, .revents = 0};
    (void)poll(&readable, 1, 1000);
  }
  throw std::runtime_error("no message on " + std::string(channel));
}

int answer(const link::RunSlot& slot, std::uint64_t ticks) {
  host::LcmEndpoint bus(host::parse_lcm_url(slot.lcm_url()), {wire::kNavStateChannel});
  link::RuntimeEnd link(slot.domain());
  link::Tick tick;
  while (tick.number < ticks) {
    if (link.receive(tick, 10s) != link::Delivery::kArrived) return 1;
    take_one(bus, wire::kNavStateChannel);
    (void)bus.publish(wire::kSetpointChannel, support::bytes_of(setpoint_t{}));
    (void)bus.publish(wire::kHealthChannel, support::bytes_of(health_t{}));
    link::Answer reply;
    reply.number = tick.number;
    link.send(reply);
  }
  return 0;
}

double measure(const link::RunSlot& slot, std::uint64_t ticks) {
  host::LcmEndpoint bus(host::parse_lcm_url(slot.lcm_url()), {wire::kSetpointChannel});
  link::SimulatorEnd link(slot.domain());
  if (!link.wait_for_runtime(10s)) throw std::runtime_error("the other process does not come");
  const auto began = std::chrono::steady_clock::now();
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    (void)bus.publish(wire::kNavStateChannel, support::bytes_of(nav_state_t{}));
    link::Tick tick;
    tick.number = n;
    link.send(tick);
    link.observe({});
    link::Answer reply;
    if (link.receive(reply, 10s) != link::Delivery::kArrived) throw std::runtime_error("a tick was not answered");
    take_one(bus, wire::kSetpointChannel);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace

int main(int argc, char** argv) try {
  const bool is_busy = argc > 1 && std::string_view(argv[1]) == "busy";
  const std::uint64_t ticks =
      is_busy ? bench::full_or_short(kTicksWhenBusy, kTicksWhenBusy / 10) : bench::full_or_short(kTicks, kTicks / 10);
  const link::RunSlot slot;
  if (is_busy) bench::use_two_processors();
  const pid_t child = fork();
  std::optional<bench::BusyLoops> others;  // after the fork: threads stay behind in it
  if (child == 0) std::_Exit(answer(slot, ticks));
  if (is_busy) others.emplace();
  const double wall_time_s = measure(slot, ticks);
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0) throw std::runtime_error("the other process did not take every tick");
  std::cout << "{\"name\":\"bare lock-step of 1 s ticks\",\"unit\":\"x\",\"value\":" << static_cast<double>(ticks) / wall_time_s << "}\n";
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
