#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/boards/linux/event_log/line_writer.hpp"
#include "firmware/boards/linux/event_log/log_format.hpp"
#include "firmware/boards/linux/port/bus_trouble.hpp"
#include "firmware/boards/linux/port/heard_chain.hpp"
#include "firmware/boards/linux/port/order_trouble.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::board {

/// Tells a person what changes while a flight lasts, a line each: the state of the mission and why, every link that goes down or comes
/// back, limits that an operator made tighter, a disk that does not take the journal, what the safety supervisor does and why, what is
/// wrong with a CAN bus and when it is over, and in each state once that navigation, SNR or a bearing is refused. Nothing allocates or
/// waits after construction.
///
///     earshotd: 2026-11-22 15:04:07 UTC: ABORT, navigation went silent, after 12 steps
///     earshotd: 2026-11-22 15:04:07 UTC: navigation: 31 messages refused so far, for their date, their order or what is in them; check
///     their sender's clock (of CAN messages, which bear no date: at two ports that bring the same)
///     earshotd: 2026-11-22 15:01:12 UTC: port 2, ears, hydrophone, LCM udpm://...: hears 15.0 to 30.0 Hz of 1 channel at 96000.0 Hz: full
///     scale 180.0, the ADC's own noise 8.4 dB re 1 uPa; SNR measurements lag by 0.24 s
///     earshotd: 2026-11-22 15:03:40 UTC: heard for 1.2 s from 2026-11-22 15:03:38 UTC: level 104.2 dB re 1 uPa, SNR 14.1 dB
///     earshotd: 2026-11-22 15:03:59 UTC: rule 11, battery_percent: 14.9, below 15.0: return
///     earshotd: 2026-11-22 15:04:09 UTC: port 1, vehicle, CAN can0: its link is down; tried again once a second
///     earshotd: 2026-11-22 15:04:10 UTC: journal: the disk takes it again; 0 records are lost
///     earshotd: 2026-11-22 15:04:12 UTC: port 1, vehicle, CAN can0: headings are magnetic, and nobody gives the variation (127258)
class EventLog {
 public:
  /// A link may have kLinkLinesAtOnce lines at once and after them one every kBetweenLinkLines, which counts the changes since the last: a
  /// link that comes and goes cannot flood.
  static constexpr int kLinkLinesAtOnce = 4;
  static constexpr Duration kBetweenLinkLines = Duration::seconds(10);
  static constexpr Duration kBetweenDetectionLines = Duration::seconds(60);

  /// @param ports   a link that is down already has no line of its own
  /// @param writer  must outlive it
  EventLog(const PortSet& ports, LineWriter& writer, LogFormat format = LogFormat::kText);

  /// Tells what the turn changed; to be called after every turn. @param now  of the turn, on the mission clock: UTC at sea, seconds from 0
  /// in simulation
  void log(Time now, const messages::Health& health);
  /// A sound that was heard; of many within kBetweenDetectionLines the first, and how many since.
  void log(Time now, std::uint8_t port, const messages::SoundDetection& detection);
  /// A rule of the safety supervisor begins to act, or no longer does; of each rule at most one line in kBetweenLinkLines, but for one that
  /// ends the mission. What comes too soon is made up for in the first turn that is due: how it is then, and how often it changed.
  void log(const messages::SafetyEvent& event);
  /// How the mission is flown. The first time it says nothing; then, once in kBetweenLinkLines, that an operator made its limits tighter.
  void log(Time now, const config::Mission& mission);
  /// With what chain a hydrophone is heard from now on, at the next turn.
  void log(std::uint8_t port, const HeardChain& chain);
  /// What is wrong with a CAN port from now on, or no longer, at the next turn; of each at most one line in kBetweenLinkLines.
  void log(std::uint8_t port, BusTrouble trouble, bool is_there);
  /// What was wrong with an order that a port brought, at the next turn; of each kind at most one line in kBetweenLinkLines, which counts
  /// those since the last.
  void log(std::uint8_t port, OrderTrouble trouble);
  /// Whether what must not be forgotten is on a disk; a change is told, once in kBetweenLinkLines at most.
  void report_durable(Time now, bool is_durable);
  /// This program is told to stop: an abort from now on is not an operator's.
  void note_program_stop() { is_stopping_ = true; }

 private:
  struct Link {
    std::string label;  ///< "port 1, vehicle, CAN can0"
    bool is_up = true;
    std::uint64_t changes = 0;  ///< since it was last told of
    Time due;                   ///< when its lines would have been told, were there one in kBetweenLinkLines
  };
  /// How many messages of a sensor the runtime refused, as far as a person knows.
  struct Refused {
    std::uint64_t reported = 0;
    bool is_reported_in_state = false;
  };
  /// What a hydrophone hears, as far as a person knows.
  struct Sound {
    std::optional<HeardChain> chain;  ///< not told of yet
    Time chain_due;
    std::uint64_t detections = 0;  ///< since the last that was told of
    Time detection_due;
  };
  /// What a TIGHTEN changes.
  struct Limits {
    Meters max_depth;
    Meters search_depth;
    MetersPerSecond search_speed;
    Duration max_time;
    friend bool operator==(const Limits&, const Limits&) = default;
  };
  /// Something that may be wrong with a port, as far as a person knows.
  struct Trouble {
    bool is_there = false;
    bool is_reported = false;
    Time due;
  };
  /// Something that was wrong with orders of a port.
  struct BadOrders {
    std::uint64_t count = 0;  ///< since they were last told of
    Time due;
  };
  /// What a rule of the safety supervisor does, as far as a person knows.
  struct RuleState {
    messages::SafetyEvent last;
    std::uint64_t changes = 0;  ///< since it was last told of
    Time due;
    /// The strongest that ended the mission, as was told: a limit that is passed again and again ends it once.
    config::Response ended_by = config::Response::kWarn;
  };
  void write(const LogEntry& entry);
  void report_rule(Time now, RuleState& rule);
  void report_troubles(Time now, std::size_t port);
  void report_orders(Time now, std::size_t port);
  void report_chain(Time now, std::size_t port);
  void report_link(Time now, const messages::PortReport& report);
  void report_journal_link(Time now, const messages::PortReport& report);
  void report_state(Time now, const messages::Health& health);
  void report_refused(Time now, std::string_view sensor, std::uint64_t count, Refused& refused);
  void report_others(Time now, std::uint64_t count);

  LineWriter& writer_;
  LogFormat format_;
  std::array<Link, config::kMaxPorts> links_;
  std::optional<messages::MissionState> state_;
  std::string_view remark_;       ///< on it
  bool is_mismatched_ = false;    ///< in this search
  Time remark_due_;               ///< as of a link: an autopilot that comes and goes cannot flood
  std::optional<Limits> limits_;  ///< as far as a person knows
  Time limits_due_;
  bool is_stopping_ = false;
  bool is_journal_up_ = true;
  bool is_durable_ = true;
  Time durable_due_;
  Refused navigation_;
  Refused snr_;
  Refused bearing_;
  Refused others_bearing_;
  std::array<Sound, config::kMaxPorts> sounds_;
  std::array<RuleState, config::kMaxRules> rules_{};
  std::array<std::array<Trouble, kBusTroubleCount>, config::kMaxPorts> troubles_{};
  std::array<std::array<BadOrders, kOrderTroubleCount>, config::kMaxPorts> bad_orders_{};
};

}  // namespace earshot::board
