#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/boards/linux/can/bus_roles.hpp"
#include "firmware/boards/linux/can/trouble_watch.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/sensors/source_gate.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

namespace earshot::board {

/// All that the runtime takes and gives but sound, as a device of an NMEA 2000 network (firmware/wire/n2k): it claims an address and keeps
/// it, says who it is, and sends nothing else as long as it has none. Measurements bear no date: the kernel's of their arrival stands for
/// it; orders bear their own.
class CanPort final : public Port {
 public:
  /// @param host  its monotonic clock times what the bus wants of a device: heartbeats do not run faster with a rehearsal's mission clock.
  /// Must outlive the port.
  /// @throws std::system_error as CanSocket does.
  CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane, const HostClock& host,
          host::IfMissing if_missing = host::IfMissing::kRefuse);

  void collect(Clock& clock, InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  [[nodiscard]] int file_descriptor() const override { return socket_.is_up() ? socket_.file_descriptor() : -1; }
  void tend() override {
    if (!socket_.is_up()) (void)socket_.reopen();
  }
  void serve() override;
  [[nodiscard]] bool settle() override;
  [[nodiscard]] messages::PortReport report() const override;
  [[nodiscard]] std::string description() const override { return name_ + ", CAN " + interface_; }
  [[nodiscard]] std::size_t memory() const override { return sizeof *this; }
  [[nodiscard]] std::string remark() const override;

 private:
  /// When a frame arrived.
  struct Arrival {
    Time utc;      ///< by this host's wall clock
    Time mission;  ///< by the mission's
  };
  /// Who is to have the acknowledgement of an order.
  struct Asker {
    std::uint32_t issuer = 0;
    std::uint32_t number = 0;
    std::uint8_t address = n2k::kNullAddress;
  };
  /// Of the next fast packet of each group.
  struct Sequences {
    std::uint8_t setpoint = 0;
    std::uint8_t acknowledgement = 0;
    std::uint8_t decision = 0;
    std::uint8_t health = 0;
    std::uint8_t port_health = 0;
    std::uint8_t challenge = 0;
  };

  [[nodiscard]] n2k::Node new_node() const;
  [[nodiscard]] Time host_now() const { return Time{} + host_.monotonic(); }
  void take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink);
  void take_navigation(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink);
  void take_snr(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink);
  void take_hull(const n2k::HeardFrame& heard, const Arrival& arrival);
  void take_autopilot_status(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink);
  void report_hearing(const Result<bool>& deaf, bool has_snr, std::uint8_t source, const Arrival& arrival, InputSink& sink);
  void report_vehicle_status(Time now, InputSink& sink);
  void note_refusal(Status status);
  void take_order(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink);
  void zero_pressure(Time now, const runtime::Outputs& outputs);
  [[nodiscard]] bool send(std::span<const n2k::Frame> frames, const host::Waiting& waiting = {});
  /// Sends one message, or counts that it could not. @param compose  Status(address to send from, Frames&)
  template <class Frames, class Compose>
  bool send_composed(Compose compose, const host::Waiting& waiting = {});
  void answer_unreadable(Time now, const messages::OperatorCommand& command, std::uint8_t sender);
  void acknowledge(const runtime::Outputs& outputs);
  void publish_challenge(Time now);
  void publish_status(Time now, const runtime::Outputs& outputs);
  [[nodiscard]] BusSigns signs() const;
  void report_troubles(Time mission_now, InputSink& sink);

  std::string name_;
  std::string interface_;
  std::string software_version_;  ///< the node's texts live as long as it does
  std::string serial_;
  const HostClock& host_;
  host::N2kSettings settings_;
  std::optional<host::CommandProof> command_proof_;
  Pgns pgns_sent_;
  Pgns pgns_read_;
  host::CanSocket socket_;
  bool was_up_ = false;  ///< when it was served last
  bool saw_bus_ = true;  ///< when it last looked for troubles
  n2k::Node node_;
  n2k::NavigationReceiver receiver_;
  n2k::VehicleCondition condition_;
  n2k::SourceGate snr_gate_;
  n2k::SourceGate autopilot_gate_;
  n2k::OrderReceiver orders_;
  std::uint64_t fixes_ = 0;
  std::uint64_t measurements_ = 0;
  std::uint64_t own_refused_ = 0;                            ///< messages of Earshot's own groups whose numbers cannot be
  std::optional<std::uint8_t> deaf_address_;                 ///< of the hydrophone that said last that it is deaf
  std::uint64_t snr_not_chosen_ = 0;                         ///< of hydrophones that the mission does not name
  FixedVector<Asker, config::kMaxAcknowledgements> askers_;  ///< since the last turn
  std::size_t unreadable_answered_ = 0;                      ///< likewise
  Sequences sequences_;
  std::uint64_t without_address_ = 0;  ///< messages that were not sent for want of one
  TroubleWatch watch_;
  BusTroubles reported_troubles_;
  BusTroubles met_troubles_;                          ///< ever
  std::optional<messages::Health> published_health_;  ///< the status told last
  Time published_at_;
  Time challenge_published_at_;
  messages::MissionState state_ = messages::MissionState::kStandby;  ///< after the last turn
  bool zero_is_due_ = false;
  bool is_zeroed_ = false;
};

template <class Frames, class Compose>
bool CanPort::send_composed(Compose compose, const host::Waiting& waiting) {
  const std::optional<std::uint8_t> address = node_.address();
  if (!address && socket_.is_up()) ++without_address_;
  Frames frames;
  if (address && compose(*address, frames) == Status::kOk && send(frames.span(), waiting)) return true;
  ++report_.unsent;
  return false;
}

}  // namespace earshot::board
