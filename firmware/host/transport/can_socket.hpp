#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/can/bus_off_wait.hpp"
#include "firmware/host/transport/can/controller.hpp"
#include "firmware/host/transport/can/filter.hpp"
#include "firmware/host/transport/can/raw_socket.hpp"
#include "firmware/host/transport/can/send_queue.hpp"
#include "firmware/host/transport/if_missing.hpp"
#include "firmware/host/transport/socket_drops.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::host {

/// Counters of a CAN socket; they only grow.
struct CanCounters {
  std::uint64_t sent = 0;         ///< frames
  std::uint64_t send_failed = 0;  ///< frames of send() that were not sent: no room, others waiting, bus-off, or the interface is down
  std::uint64_t no_room = 0;      ///< times that the kernel had no room for a frame (ENOBUFS, EAGAIN)
  std::uint64_t received = 0;
  std::uint64_t other_frames = 0;     ///< 11-bit and remote frames, CAN FD and XL: not NMEA 2000
  std::uint64_t lost_by_kernel = 0;   ///< arrived faster than they were taken: the kernel drops the newest
  std::uint64_t errors = 0;           ///< what the kernel said instead of giving or taking a frame: the interface is down or gone
  std::uint64_t bus_off_retries = 0;  ///< times that sending was tried again after the controller had left the bus
  CanSendQueueCounters groups;        ///< of send_whole()
  CanErrorCounters controller;
};

/// A raw SocketCAN socket on one interface. Never waits; does not hear its own frames; allocates nothing once it is made.
///
/// What the filters keep away costs this process nothing. Frames and their arrival are received; error frames keep `controller_state`.
/// Frames that are to be sent together wait, if they have to, by priority (CanSendQueue); flush() gives the kernel as many as it takes.
/// While the controller is bus-off nothing is sent: the kernel brings it back if the interface has restart-ms
/// (`ip link set can0 type can restart-ms 100`), and sending begins again after BusOffWait. An interface without a carrier counts as
/// bus-off, whatever its controller says: what is sent on it the kernel throws away, and says that it was sent.
class CanSocket {
 public:
  /// @throws std::system_error naming the interface and the call that failed: a name that no interface can have and an interface that is no
  /// CAN bus always, a missing one with kRefuse; with kKeepTrying it is down until reopen() finds it.
  explicit CanSocket(const std::string& interface, IfMissing if_missing = IfMissing::kRefuse, const CanOptions& options = {});

  /// Other filters from now on (our address has changed). Frames that wait to be read still come. @return false: the kernel refused them
  [[nodiscard]] bool set_filters(const CanFilters& filters);

  /// One frame at once, or not at all. kFull: it was not sent; try again or count it as lost.
  [[nodiscard]] Status send(const n2k::Frame& frame);
  /// Frames that belong together: all of them, in their order, or, if the kernel has no room in time, a beginning of which nobody can make
  /// anything: a fast packet without its end. What must not act without the rest therefore goes first, what acts goes last.
  /// @param now  any clock that does not jump, the same for flush()
  /// @return kOk: the kernel has all of it. kNotReady: it waits; what becomes of it, the counters tell. kFull: refused, counted.
  /// kOutOfRange: no frame, or more than a group may have.
  [[nodiscard]] Status send_whole(std::span<const n2k::Frame> frames, Time now, const Waiting& waiting = {});
  /// Gives the kernel what waits, as far as it has room. To be called every turn.
  void flush(Time now);

  /// The next extended data frame; kNotReady if none has arrived, or none among the next kCanFramesPerCollect frames.
  [[nodiscard]] Status receive(n2k::Frame& frame);
  /// Likewise, and takes every frame read, also of another kind, from `budget`: kNotReady once it is used up, so that a flood cannot hold
  /// the caller.
  /// @param received_utc  when it arrived (arrival_of), though it be read later; negative if the kernel does not say
  [[nodiscard]] Status receive(n2k::Frame& frame, Time& received_utc, std::size_t& budget);

  /// False while the interface is missing, once the kernel has said that it is down or gone until reopen() finds it, and while the
  /// controller is bus-off.
  [[nodiscard]] bool is_up() const { return is_interface_up_ && !controller_.is_bus_off(); }
  /// Tries to be on the interface again, with the same filters; allocates nothing. Of a controller that is bus-off it waits, as always.
  /// @return is_up()
  bool reopen();

  [[nodiscard]] n2k::ControllerState controller_state() const { return controller_.state(); }
  [[nodiscard]] const CanController& controller() const { return controller_; }
  /// Groups of send_whole() that wait.
  [[nodiscard]] std::size_t waiting() const { return queue_.waiting(); }
  /// Frames that may wait to be read: less than asked for where the kernel did not grant it (sysctl net.core.rmem_max).
  [[nodiscard]] std::size_t room_frames() const { return host::room_frames(socket_.number()); }
  [[nodiscard]] int file_descriptor() const { return socket_.number(); }
  [[nodiscard]] CanCounters counters() const;

 private:
  [[nodiscard]] Status pass_to_kernel(const n2k::Frame& frame);
  void tend_bus_off(Time now);
  void poll_carrier(Time now);
  void note_error(int error);

  std::string interface_;
  CanOptions options_;
  FileDescriptor socket_;
  int index_ = 0;  ///< of the interface that the socket is bound to
  bool is_interface_up_ = true;
  CanController controller_;
  BusOffWait bus_off_wait_;
  std::uint64_t bus_offs_seen_ = 0;
  std::optional<Time> polled_carrier_;
  CanSendQueue queue_;
  CanCounters counters_;
  SocketDrops drops_;
};

}  // namespace earshot::host
