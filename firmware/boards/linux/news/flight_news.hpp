#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/boards/linux/news/line_writer.hpp"
#include "firmware/boards/linux/port_set.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::board {

/// Tells a person what changes while a flight lasts, a line each: the state of the mission and why, every link that goes down or comes
/// back, and in each state once that navigation or SNR is refused. Nothing allocates or waits after construction.
///
///     earshotd: 2026-11-22 15:04:07 UTC: ABORT, navigation went silent, after 12 steps
///     earshotd: 2026-11-22 15:04:07 UTC: navigation: 31 messages refused so far, for their date, their order or what is in them; look at
///     the clock of their sender
///     earshotd: 2026-11-22 15:04:09 UTC: port 1, vehicle, CAN can0: its link is down; tried again once a second
class FlightNews {
 public:
  /// A link may have kLinkLinesAtOnce lines at once and after them one every kBetweenLinkLines, which counts the changes since the last: a
  /// link that comes and goes cannot flood.
  static constexpr int kLinkLinesAtOnce = 4;
  static constexpr Duration kBetweenLinkLines = Duration::seconds(10);

  /// @param ports   a link that is down already has no line of its own
  /// @param writer  must outlive it
  FlightNews(const PortSet& ports, LineWriter& writer);

  /// Tells what the turn changed; to be called after every turn. @param now  of the turn, on the mission clock: UTC at sea, seconds from 0
  /// in simulation
  void tell(Time now, const messages::Health& health);

 private:
  struct Link {
    std::string label;  ///< "port 1, vehicle, CAN can0"
    bool is_up = true;
    std::uint64_t changes = 0;  ///< since it was last told of
    Time due;                   ///< when its lines would have been told, were there one in kBetweenLinkLines
  };
  /// How many messages of a sensor the runtime refused, as far as a person knows.
  struct Refused {
    std::uint64_t told = 0;
    bool is_told_in_state = false;
  };
  void tell_link(Time now, const messages::PortReport& report);
  void tell_state(Time now, const messages::Health& health);
  void tell_refused(Time now, std::string_view sensor, std::uint64_t count, Refused& refused);

  LineWriter& writer_;
  std::array<Link, config::kMaxPorts> links_;
  std::optional<messages::MissionState> state_;
  Refused navigation_;
  Refused snr_;
};

}  // namespace earshot::board
