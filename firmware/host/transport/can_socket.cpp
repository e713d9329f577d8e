#include "firmware/host/transport/can_socket.hpp"

#include <linux/can.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/host/transport/can/arrival.hpp"
#include "firmware/host/transport/interface_name.hpp"

namespace earshot::host {

namespace {

[[noreturn]] void fail(const std::string& interface, const char* call) {
  throw std::system_error(errno, std::generic_category(), "CAN interface " + interface + ": " + call);
}

constexpr Duration kCarrierPollInterval = Duration::seconds(1);

bool means_nothing_yet(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

bool is_nmea_2000(const can_frame& frame) {
  return (frame.can_id & CAN_EFF_FLAG) != 0 && (frame.can_id & CAN_RTR_FLAG) == 0 && frame.can_dlc <= CAN_MAX_DLEN;
}

n2k::Frame frame_of(const can_frame& in) {
  n2k::Frame frame{.identifier = in.can_id & CAN_EFF_MASK, .size = in.can_dlc};
  std::copy_n(in.data, in.can_dlc, frame.data.begin());
  return frame;
}

}  // namespace

CanSocket::CanSocket(const std::string& interface, IfMissing if_missing, const CanOptions& options)
    : interface_(interface), options_(options) {
  if (!is_interface_name(interface)) {
    errno = EINVAL;
    fail(interface, kInterfaceNameRule);
  }
  const char* failed = nullptr;
  socket_ = open_raw_can(interface, options_, failed);
  if (socket_.number() < 0 && (failed != kInterfaceNotFound || if_missing == IfMissing::kRefuse)) fail(interface, failed);
  index_ = static_cast<int>(::if_nametoindex(interface.c_str()));
  is_interface_up_ = socket_.number() >= 0 && index_if_up(socket_.number(), interface) == index_;
}

void CanSocket::note_error(int error) {
  ++counters_.errors;
  if (error == ENODEV || error == ENXIO) {  // it is bound to none any more, though one may be there of the same name and index
    is_interface_up_ = false;
    return;
  }
  is_interface_up_ = index_if_up(socket_.number(), interface_) == index_;  // another of that name is not the one that it is bound to
}

bool CanSocket::reopen() {
  if (is_interface_up_) return is_up();
  const char* failed = nullptr;
  FileDescriptor socket = open_raw_can(interface_, options_, failed);
  const int index = socket.number() < 0 ? 0 : index_if_up(socket.number(), interface_);
  if (index == 0) return false;
  index_ = index;
  (void)drops_.count(socket_.number());
  socket_ = std::move(socket);
  drops_.restart();
  controller_.restart();
  return is_interface_up_ = true;
}

bool CanSocket::set_filters(const CanFilters& filters) {
  options_.filters = filters;
  return socket_.number() < 0 || host::set_filters(socket_.number(), filters);
}

CanCounters CanSocket::counters() const {
  CanCounters counters = counters_;
  counters.lost_by_kernel = drops_.count(socket_.number());
  counters.groups = queue_.counters();
  counters.controller = controller_.counters();
  return counters;
}

Status CanSocket::pass_to_kernel(const n2k::Frame& frame) {
  if (socket_.number() < 0 || !is_up() || bus_off_wait_.is_under_way()) return Status::kFull;
  can_frame out{};
  out.can_id = (frame.identifier & CAN_EFF_MASK) | CAN_EFF_FLAG;
  out.can_dlc = std::min<std::uint8_t>(frame.size, CAN_MAX_DLEN);
  std::copy_n(frame.data.begin(), out.can_dlc, out.data);
  if (::send(socket_.number(), &out, sizeof out, 0) == sizeof out) {
    ++counters_.sent;
    return Status::kOk;
  }
  if (!means_nothing_yet(errno) && errno != ENOBUFS) {
    note_error(errno);
    return Status::kFull;
  }
  ++counters_.no_room;
  // An interface that was bus-off before we came told us nothing.
  if (!has_carrier(socket_.number(), interface_)) controller_.note_bus_off();
  return Status::kFull;
}

Status CanSocket::send(const n2k::Frame& frame) {
  const Status status = queue_.next() != nullptr ? Status::kFull : pass_to_kernel(frame);
  if (status != Status::kOk) ++counters_.send_failed;
  return status;
}

Status CanSocket::send_whole(std::span<const n2k::Frame> frames, Time now, const Waiting& waiting) {
  queue_.expire(now);
  const Status status = queue_.push(frames, now, waiting);
  if (status != Status::kOk) return status;
  flush(now);
  return queue_.holds_newest() ? Status::kNotReady : Status::kOk;
}

void CanSocket::flush(Time now) {
  tend_bus_off(now);
  queue_.expire(now);
  for (const n2k::Frame* frame = queue_.next(); frame != nullptr && pass_to_kernel(*frame) == Status::kOk; frame = queue_.next())
    queue_.pop(now);
}

/// An interface that was bus-off before we came told us nothing, and one whose controller comes back need not have its carrier again.
void CanSocket::poll_carrier(Time now) {
  if (socket_.number() < 0 || !is_interface_up_) return;
  if (polled_carrier_ && lies_within(*polled_carrier_, now, kCarrierPollInterval)) return;
  polled_carrier_ = now;
  if (!has_carrier(socket_.number(), interface_)) controller_.note_bus_off();
}

void CanSocket::tend_bus_off(Time now) {
  poll_carrier(now);
  if (controller_.counters().bus_off != bus_offs_seen_) {
    bus_offs_seen_ = controller_.counters().bus_off;
    bus_off_wait_.begin(now);
  }
  if (!bus_off_wait_.ends(now)) return;
  ++counters_.bus_off_retries;
  if (!controller_.is_bus_off()) return;
  // Its error frame of the restart may be lost; the carrier tells whether there was one.
  if (has_carrier(socket_.number(), interface_)) {
    controller_.restart();
  } else {
    bus_off_wait_.begin(now);
  }
}

Status CanSocket::receive(n2k::Frame& frame) {
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  return receive(frame, received_utc, budget);
}

Status CanSocket::receive(n2k::Frame& frame, Time& received_utc, std::size_t& budget) {
  if (socket_.number() < 0) return Status::kNotReady;
  while (budget > 0) {
    can_frame in{};
    iovec piece{&in, sizeof in};
    StampRoom stamps{};
    msghdr header{};
    header.msg_iov = &piece;
    header.msg_iovlen = 1;
    header.msg_control = stamps.bytes;
    header.msg_controllen = sizeof stamps.bytes;
    const ssize_t size = ::recvmsg(socket_.number(), &header, 0);
    if (size < 0) {
      if (!means_nothing_yet(errno)) note_error(errno);
      return Status::kNotReady;
    }
    --budget;
    const bool is_classic = size == sizeof in && (header.msg_flags & MSG_TRUNC) == 0;  // CAN FD and XL are larger
    if (is_classic && (in.can_id & CAN_ERR_FLAG) != 0) {
      controller_.accept_error(in);
      continue;
    }
    if (!is_classic || !is_nmea_2000(in)) {
      ++counters_.other_frames;
      continue;
    }
    const bool is_from_bus = (header.msg_flags & MSG_DONTROUTE) == 0;  // not from this computer
    if (is_from_bus && controller_.is_bus_off() && has_carrier(socket_.number(), interface_)) controller_.note_reception();
    received_utc = arrival_of(header).value_or(Time{-1});
    frame = frame_of(in);
    ++counters_.received;
    return Status::kOk;
  }
  return Status::kNotReady;
}

}  // namespace earshot::host
