#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "firmware/boards/linux/port/port.hpp"
#include "firmware/boards/linux/port/received_orders.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"

namespace earshot::board {

/// All that the runtime takes and gives, as LCM messages (firmware/wire/lcm). Every date on the bus is the wall clock's, whatever clock the
/// mission goes by. Owns the endpoint on the bus, and the count of strangers' messages in a simulation.
class LcmPort final : public Port, public DetectionSender {
 public:
  /// @throws std::system_error, std::invalid_argument as LcmEndpoint and parse_lcm_url do.
  LcmPort(std::uint8_t index, const host::PortSettings& settings, host::IfMissing if_missing = host::IfMissing::kRefuse);

  void collect(Clock& clock, InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  void publish_detection(const messages::SoundDetection& detection) override;
  [[nodiscard]] int file_descriptor() const override { return endpoint_.file_descriptor(); }
  void tend() override { endpoint_.refresh_interfaces(); }
  [[nodiscard]] messages::PortReport report() const override;
  [[nodiscard]] std::size_t memory() const override { return sizeof *this + endpoint_.memory(); }
  [[nodiscard]] PortWords words() const override;
  [[nodiscard]] FurtherDuties further_duties() override { return {.detection_sender = this}; }

 private:
  [[nodiscard]] std::string label() const { return name_ + ", LCM " + address_; }
  [[nodiscard]] std::string remark() const;
  [[nodiscard]] std::string strangers() const;
  /// On the bus.
  [[nodiscard]] Time date_of(Time mission_time) const { return clock_ == nullptr ? mission_time : clock_->utc_of(mission_time); }
  template <class Message>
  bool send(std::string_view channel, const Message& message, Time now = {});
  /// What bears a date of its own.
  template <class Message>
  void send_dated(std::string_view channel, Message message);
  /// @return whether it is one that this port brings
  [[nodiscard]] bool take(Clock& clock, const wire::Lc02Message& message, InputSink& sink);
  /// @return whether it is none of this flight's: then it is counted here, and nowhere else, so that the flight stays what it is
  [[nodiscard]] bool is_strangers(const wire::Lc02Message& message);
  /// @return whether it is one, or as much of one as stops a vehicle
  [[nodiscard]] bool take_order(Clock& clock, std::span<const std::uint8_t> data, InputSink& sink);
  template <class Message>
  [[nodiscard]] bool takes(Clock& clock, std::span<const std::uint8_t> data, InputSink& sink);

  std::string name_;
  std::string address_;
  ReceivedOrders orders_;
  bool snr_is_simulators_;
  std::uint64_t strangers_snr_ = 0;
  std::uint64_t strangers_bearings_ = 0;
  host::LcmEndpoint endpoint_;
  Clock* clock_ = nullptr;  ///< that what came was dated by; null: nothing was looked for yet
};

}  // namespace earshot::board
