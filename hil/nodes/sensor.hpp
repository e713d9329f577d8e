#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/table/signal.hpp"
#include "hil/nodes/device.hpp"
#include "hil/nodes/membership.hpp"
#include "hil/nodes/pace.hpp"

namespace earshot::hil {

/// When and from where a message is said.
struct Occasion {
  Time now;
  std::uint8_t source = 0;
  std::uint8_t count = 0;  ///< one higher for every message of the kind, 0 to 252: its SID, and its number as a fast packet
};

/// One message that a sensor sends with a period.
struct Broadcast {
  const n2k::Message& message;
  Duration period;
  /// Adds its frames. Otherwise than kOk: the value does not fit its message, and nothing is sent.
  std::function<Status(const Occasion&, Frames&)> compose;
};

/// A device that says what it measures, whoever listens.
class Sensor final : public Device {
 public:
  Sensor(const Nameplate& plate, std::vector<Broadcast> broadcasts);

  [[nodiscard]] std::string_view name() const override { return membership_.model(); }
  [[nodiscard]] std::optional<std::uint8_t> address() const override { return membership_.address(); }
  void accept(const n2k::Frame& frame, Time now) override { membership_.accept(frame, now); }
  void step(Time now, Frames& frames) override;

  [[nodiscard]] const Membership& membership() const { return membership_; }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }      ///< messages
  [[nodiscard]] std::uint64_t unsent() const { return unsent_; }  ///< messages whose value did not fit

 private:
  struct Paced {
    Broadcast broadcast;
    Pace pace;
    std::uint8_t count = 0;
  };
  Membership membership_;
  std::vector<Paced> broadcasts_;
  std::uint64_t sent_ = 0;
  std::uint64_t unsent_ = 0;
};

}  // namespace earshot::hil
