#pragma once

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/host/transport/wake_event.hpp"
#include "firmware/wire/n2k/node/node.hpp"

namespace earshot::hil {

/// This kernel gives no CAN interface at the end of a serial line: it has no slcan, or we are not root.
class NoSerialCan : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A CAN adapter at the end of a serial line, which is a pseudo-terminal: an interface of its own (slcan) is on the bus of another one
/// through it. Its controller can be in trouble, which the kernel is told as such an adapter tells it: who is on the interface gets
/// error frames, and the kernel counts. Error-passive it still passes frames; bus-off it passes none either way.
/// Oracle: SerialAdapter tests
class SerialAdapter {
 public:
  /// Makes the interface, and takes it up. @param bus  interface whose bus it is on
  /// @throws NoSerialCan; std::system_error as host::CanSocket does
  explicit SerialAdapter(const std::string& bus);
  ~SerialAdapter();
  SerialAdapter(const SerialAdapter&) = delete;
  SerialAdapter& operator=(const SerialAdapter&) = delete;

  /// Its name, which the kernel gave: "can0".
  [[nodiscard]] const std::string& interface() const { return interface_; }
  /// The controller has this state from now on. From bus-off it comes back as a person or a service brings it back, who takes the interface
  /// down and up: slcan's has no restart-ms.
  void become(n2k::ControllerState state);
  [[nodiscard]] std::uint64_t passed() const { return passed_; }    ///< frames, either way
  [[nodiscard]] std::uint64_t refused() const { return refused_; }  ///< frames that came while it was bus-off, or found no room

 private:
  void relay(const std::stop_token& stop);
  void pass_to_bus();
  void pass_to_line();
  void report_state();
  void take_line(std::string_view line);
  void write_line();

  host::FileDescriptor far_end_;   ///< of the line: the adapter's
  host::FileDescriptor near_end_;  ///< the kernel's, which makes an interface of it as long as it is open
  std::string interface_;
  host::CanSocket bus_;
  host::WakeEvent wake_event_;
  std::atomic<n2k::ControllerState> state_ = n2k::ControllerState::kErrorActive;
  n2k::ControllerState reported_ = n2k::ControllerState::kErrorActive;
  std::string received_;  ///< of a line that is not whole yet
  std::string unwritten_;
  std::atomic<std::uint64_t> passed_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;
  std::jthread thread_;  ///< after what it uses
};

}  // namespace earshot::hil
