#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/if_missing.hpp"
#include "firmware/host/transport/socket_drops.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::host {

/// Counters of a CAN socket; they only grow.
struct CanCounters {
  std::uint64_t sent = 0;
  std::uint64_t send_failed = 0;  ///< the interface's queue was full or it is down
  std::uint64_t received = 0;
  std::uint64_t other_frames = 0;    ///< 11-bit, remote and error frames: not NMEA 2000
  std::uint64_t lost_by_kernel = 0;  ///< arrived faster than they were taken: the kernel drops the newest
  std::uint64_t errors = 0;          ///< what the kernel said instead of giving or taking a frame: the interface is down or gone
};

/// A raw SocketCAN socket on one interface. Never waits; does not hear its own frames.
class CanSocket {
 public:
  /// @throws std::system_error naming the interface and the call that failed: a name that no interface can have and an interface that is no
  /// CAN bus always, a missing one with kRefuse; with kKeepTrying it is down until reopen() finds it.
  explicit CanSocket(const std::string& interface, IfMissing if_missing = IfMissing::kRefuse);

  /// kFull: the frame was not sent; try again or count it as lost.
  [[nodiscard]] Status send(const n2k::Frame& frame);
  /// The next extended data frame; kNotReady if none has arrived, or none among the next kCanFramesPerCollect frames.
  [[nodiscard]] Status receive(n2k::Frame& frame);
  /// Likewise, and takes every frame read, also of another kind, from `budget`: kNotReady once it is used up, so that a flood cannot hold
  /// the caller.
  /// @param received_utc  when the kernel received it
  [[nodiscard]] Status receive(n2k::Frame& frame, Time& received_utc, std::size_t& budget);

  /// False while the interface is missing, and once the kernel has said that it is down or gone, until reopen() finds it.
  [[nodiscard]] bool is_up() const { return is_up_; }
  /// Tries to be on the interface again; allocates nothing. @return is_up()
  bool reopen();

  [[nodiscard]] int file_descriptor() const { return socket_.number(); }
  [[nodiscard]] CanCounters counters() const;

 private:
  void note_error();

  std::string interface_;
  FileDescriptor socket_;
  int index_ = 0;  ///< of the interface that the socket is bound to
  bool is_up_ = true;
  CanCounters counters_;
  SocketDrops drops_;
};

}  // namespace earshot::host
