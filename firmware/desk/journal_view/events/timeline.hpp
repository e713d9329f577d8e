#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/messages/port_report.hpp"

namespace earshot::journal {

/// One thing that happened.
struct Event {
  enum class Severity : std::uint8_t { kInformation, kWarning, kError } severity = Severity::kInformation;
  Time time;
  std::string text;
  enum class Kind : std::uint8_t { kOrder, kAnswer, kState, kRule, kLink, kDecision, kJournal, kOther } kind = Kind::kOther;
  bool is_lack = false;  ///< the journal itself is damaged, or misses something
};

/// "2026-11-22 15:04:07 UTC     187.0 s  ABORT, navigation went silent, after 12 steps"; of a simulator's clock without the date.
/// @param began  when the seconds count from
[[nodiscard]] std::string to_line(const Event& event, Time began);

/// What happened on a mission, out of the entries of its journal: orders, states, decisions, rules that act, what comes and goes, and what
/// the journal lacks. What comes in a stream (fixes, SNR, set-points, health) is an event only where it changes something.
class Timeline {
 public:
  /// The events of the next entry, in order; mostly none.
  [[nodiscard]] std::vector<Event> take(const Entry& entry);
  /// At the journal's end: what is missing there. @param torn  what stands behind its last record
  [[nodiscard]] std::vector<Event> finish(const std::optional<TornEnd>& torn);

  /// Of the journal's first record.
  [[nodiscard]] Time began() const { return began_.value_or(Time{}); }
  /// The closing record has been.
  [[nodiscard]] bool is_closed() const { return is_closed_; }

 private:
  /// Something that is said anew whenever it changes; what it was before it was first heard of needs no words.
  template <class Value>
  struct Reported {
    Value value{};
    [[nodiscard]] bool changes_to(const Value& now) {
      const bool is_new = value != now;
      value = now;
      return is_new;
    }
  };
  /// A counter of what went wrong that only grows: told when it first does in a state of the mission.
  struct Grown {
    std::uint64_t seen = 0;
    bool is_reported = false;
    [[nodiscard]] bool has_grown(std::uint64_t now);
  };

  /// An order, or what came of it: who gives one sends it until it is answered, and each time it is answered.
  struct Order {
    Event::Severity severity;
    Event::Kind kind;
    std::string text;
    std::uint64_t times = 1;
    std::uint64_t reported_times = 1;
  };
  static constexpr std::size_t kRememberedOrders = 16;  ///< full: the oldest would be told as a new one

  void add(Event::Severity severity, std::string text, bool is_lack = false);
  /// At once the first time; how often it came once something else happens.
  void add_order(Event::Severity severity, std::string text);
  void add_repetitions();
  void inform(std::string text) { add(Event::Severity::kInformation, std::move(text)); }
  /// Of the journal itself.
  void add_lack(std::string text);
  void warn(std::string text) { add(Event::Severity::kWarning, std::move(text)); }

  void note(const Record& record);
  void note(const MissingRecords& missing);
  void note(const DamagedBytes& damage);
  void note(const NumbersGoBack& numbers);
  void note(const BusLog& log);

  void note_content(const Unreadable& unreadable, const Record& record);
  void note_content(const messages::MissionRecord& mission, const Record& record);
  void note_content(const PolicyBytes& policy, const Record& record);
  void note_content(const TablesBytes& tables, const Record& record);
  void note_bytes(const std::string& text, std::uint32_t crc32, std::optional<std::uint32_t> named);
  void note_content(const messages::Input& input, const Record& record);
  void note_content(const messages::Setpoint& setpoint, const Record& record);
  void note_content(const messages::Decision& decision, const Record& record);
  void note_content(const messages::SafetyEvent& event, const Record& record);
  void note_content(const messages::CommandAcknowledgement& acknowledgement, const Record& record);
  void note_content(const messages::Health& health, const Record& record);
  void note_content(const messages::ClosingRecord& closing, const Record& record);
  void note_content(const messages::JournalResumed& resumed, const Record& record);
  void note_content(const messages::ControllerTrouble& trouble, const Record& record);
  void note_content(const messages::SoundDetection& detection, const Record& record);
  void note_content(const messages::PublishedChallenge& challenge, const Record& record);

  void note_input(const messages::PortReport& report, std::uint8_t port);
  void note_input(const messages::UnsentSetpoints& unsent, std::uint8_t port);
  void note_input(const messages::VehicleStatus& status, std::uint8_t port);
  void note_input(const messages::AutopilotStatus& status, std::uint8_t port);
  void note_input(const messages::HydrophoneStatus& status, std::uint8_t port);
  void note_input(const messages::OperatorCommand& command, std::uint8_t port);
  /// Fixes and measurements.
  template <class Stream>
  void note_input(const Stream& /*value*/, std::uint8_t /*port*/) {}
  void note_refused(const messages::Health& health);

  struct Port {
    Reported<bool> is_down;
    Grown failures;  ///< messages lost, malformed or not sent
  };

  std::vector<Event> events_;               ///< of the entry that is taken
  Event::Kind kind_ = Event::Kind::kOther;  ///< of what it holds
  std::deque<Order> orders_;                ///< that were told
  std::optional<Time> began_;
  Time now_;
  bool is_bus_log_ = false;
  bool is_closed_ = false;
  bool is_over_ = false;               ///< the mission
  bool is_mismatch_reported_ = false;  ///< in this search
  AbortedBy aborted_by_ = AbortedBy::kOperator;
  std::optional<std::uint32_t> policy_crc32_;  ///< that the mission names
  std::optional<std::uint32_t> tables_crc32_;  ///< likewise
  Reported<std::string> state_;
  Reported<std::optional<messages::MissionState>> mission_state_;
  Reported<bool> releases_weight_;
  Reported<bool> has_leak_;
  Reported<bool> has_ground_fault_;
  Reported<std::optional<bool>> follows_;
  Reported<bool> is_deaf_;
  Grown navigation_refused_;
  Grown snr_refused_;
  Grown status_refused_;
  Grown bearings_refused_;
  Grown bearings_of_others_;
  Grown unreadable_;
  Grown unsent_setpoints_;
  std::array<Port, config::kMaxPorts + 1> ports_{};
};

}  // namespace earshot::journal
