#pragma once

#include <cstdint>
#include <string>

#include "firmware/boards/linux/port.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/navigation.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

namespace earshot::board {

/// Navigation in and set-points out as NMEA 2000 frames (firmware/wire/n2k). Frames bear no date: the kernel's of their arrival stands for
/// it.
class CanPort final : public Port {
 public:
  /// @throws std::system_error as CanSocket does.
  CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane,
          host::IfMissing if_missing = host::IfMissing::kRefuse);

  void collect(Clock& clock, InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  [[nodiscard]] int file_descriptor() const override { return socket_.is_up() ? socket_.file_descriptor() : -1; }
  void tend() override {
    if (!socket_.is_up()) (void)socket_.reopen();
  }
  [[nodiscard]] messages::PortReport report() const override;
  [[nodiscard]] std::string description() const override { return name_ + ", CAN " + interface_; }
  [[nodiscard]] std::size_t memory() const override { return sizeof *this; }
  [[nodiscard]] std::string remark() const override;

 private:
  [[nodiscard]] Status send(const messages::Setpoint& setpoint);

  std::string name_;
  std::string interface_;
  host::CanSocket socket_;
  n2k::NavigationReceiver receiver_;
  std::uint8_t sequence_ = 0;
};

}  // namespace earshot::board
