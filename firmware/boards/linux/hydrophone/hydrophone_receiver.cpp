#include "firmware/boards/linux/hydrophone/hydrophone_receiver.hpp"

#include <poll.h>
#include <pthread.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"

namespace earshot::board {
namespace {

constexpr std::chrono::seconds kTendEvery{1};

}  // namespace

HydrophoneReceiver::HydrophoneReceiver(const std::string& url, SampleSink& sink, host::IfMissing if_missing)
    : sink_(sink),
      endpoint_(host::parse_lcm_url(url), {wire::kHydrophoneBlockChannel}, nullptr, if_missing),
      interfaces_(endpoint_.interfaces()),
      link_up_(endpoint_.is_up()),
      listening_([this](const std::stop_token& stop) { listen(stop); }),
      receiving_([this](const std::stop_token& stop) { receive(stop); }) {}

void HydrophoneReceiver::receive(const std::stop_token& stop) {
  const std::stop_callback waking(stop, [this] { stop_receiving_.signal(); });
  using std::chrono::steady_clock;
  (void)::pthread_setname_np(::pthread_self(), "receive sound");  // for who looks at the threads of a flight
  auto next_tending = steady_clock::now() + kTendEvery;
  while (!stop.stop_requested()) {
    std::array<pollfd, 2> waiting{pollfd{.fd = endpoint_.file_descriptor(), .events = POLLIN, .revents = 0},
                                  pollfd{.fd = stop_receiving_.file_descriptor(), .events = POLLIN, .revents = 0}};
    (void)::poll(waiting.data(), waiting.size(), static_cast<int>(std::chrono::milliseconds(kTendEvery).count()));
    take_all_that_arrived();
    note_transport();
    if (steady_clock::now() < next_tending) continue;
    next_tending = steady_clock::now() + kTendEvery;
    endpoint_.refresh_interfaces();
  }
}

/// One datagram at a time: the endpoint's own queue keeps the newest few, and here every block counts. Not more than a collect() reads, so
/// that a flood cannot keep the thread from its end.
void HydrophoneReceiver::take_all_that_arrived() {
  for (std::size_t i = 0; i < config::kLcmDatagramsPerCollect && endpoint_.collect(1) == 1; ++i) {
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) put(message);
  }
}

void HydrophoneReceiver::put(const wire::Lc02Message& message) {
  wire::HydrophoneMessage read;
  if (wire::read_hydrophone_block(message.data, read) != Status::kOk) {
    malformed_blocks_.add(1);
    return;
  }
  const std::span<float> room = ring_.room_for(read.sample_count());
  if (room.empty()) {
    samples_overrun_.add(read.block.samples_per_channel);
    return;
  }
  wire::copy_samples(read, room);
  ring_.put(read.block);
  blocks_.add(1);
  put_.signal();
}

void HydrophoneReceiver::note_transport() {
  const host::LcmCounters lcm = endpoint_.counters();
  malformed_datagrams_.set(lcm.datagrams.malformed + lcm.datagrams.too_large);
  datagrams_overrun_.set(lcm.lost_by_kernel + lcm.datagrams.incomplete);
  link_up_ = endpoint_.is_up();
}

void HydrophoneReceiver::listen(const std::stop_token& stop) {
  const std::stop_callback waking(stop, [this] { put_.signal(); });
  (void)::pthread_setname_np(::pthread_self(), "hear sound");
  for (bool is_last = false; !is_last;) {
    pollfd waiting{.fd = put_.file_descriptor(), .events = POLLIN, .revents = 0};
    (void)::poll(&waiting, 1, -1);
    put_.clear();
    is_last = stop.stop_requested();  // before the ring is emptied: what was put before it is heard
    for (BlockRing::SampledBlock oldest; ring_.take(oldest); ring_.release()) sink_.hear(oldest.block, oldest.samples);
  }
}

HydrophoneReceiver::Counters HydrophoneReceiver::counters() const {
  return {.blocks = blocks_.value(),
          .samples_overrun = samples_overrun_.value(),
          .malformed = malformed_blocks_.value() + malformed_datagrams_.value(),
          .datagrams_overrun = datagrams_overrun_.value(),
          .link_up = link_up_};
}

}  // namespace earshot::board
