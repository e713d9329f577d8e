#include "hil/nodes/bus_connection.hpp"

#include <poll.h>

#include <algorithm>

#include "firmware/config/capacities.hpp"
#include "firmware/host/transport/timespec.hpp"

namespace earshot::hil {
namespace {

constexpr Duration kShortestPeriod = Duration::milliseconds(100);  ///< of a message, in the devices' time
constexpr Duration kLeastWait = Duration::milliseconds(1);         ///< on the host: no faster is worth a processor of its own
constexpr Duration kMostWait = Duration::milliseconds(100);        ///< on the host: whoever stops us waits no longer
constexpr Duration kReopenAfter = Duration::seconds(1);            ///< on the host

}  // namespace

BusConnection::BusConnection(const std::string& interface, EmulatedVehicle& vehicle, const ScaledClock& clock)
    : socket_(interface, host::IfMissing::kKeepTrying), vehicle_(vehicle), clock_(clock) {}

void BusConnection::turn() {
  wait();
  const Time host_now = ScaledClock::host_now();
  if (!socket_.is_up() && (!reopened_ || host_now - *reopened_ >= kReopenAfter)) {
    reopened_ = host_now;
    (void)socket_.reopen();
  }
  socket_.flush(host_now);  // brings back a controller that was bus-off
  receive();
  sent_.clear();
  vehicle_.step(clock_.now(), sent_);
  send();
}

void BusConnection::wait() const {
  const Duration most = std::clamp(clock_.on_host(kShortestPeriod), kLeastWait, kMostWait);
  const timespec timeout = host::timespec_of(most);
  pollfd readable{.fd = socket_.is_up() ? socket_.file_descriptor() : -1, .events = POLLIN, .revents = 0};
  (void)ppoll(&readable, 1, &timeout, nullptr);
}

void BusConnection::receive() {
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) vehicle_.accept(frame, clock_.now());
}

/// In order: what the interface does not take waits, and all behind it. On an interface that is down nothing waits: it would come too late.
void BusConnection::send() {
  for (const n2k::Frame& frame : sent_) {
    if (waiting_.size() < kWaitingFrames) {
      waiting_.push_back(frame);
    } else {
      ++lost_;
    }
  }
  while (!waiting_.empty() && socket_.send(waiting_.front()) == Status::kOk) waiting_.pop_front();
  if (socket_.is_up()) return;
  lost_ += waiting_.size();
  waiting_.clear();
}

}  // namespace earshot::hil
