#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {

/// A flight as its vehicle journalled it, without a simulator's files: at sea nobody else knows where it went. Times are seconds since the
/// journal's first record.
struct SeaFlight {
  Time began;          ///< when the journal begins, on the mission's clock: at sea UTC
  Rectangle area;      ///< where it was to search
  Decibels threshold;  ///< of a detection
  Meters depth;        ///< of the search
  MetersPerSecond speed;
  Hertz frequency;    ///< of the source that it searched for
  std::string build;  ///< version and commit of the program that flew

  struct Fix {
    double time_s = 0.0;
    NorthEast position;
    Meters depth;
  };
  std::vector<Fix> fixes;

  struct Measurement {
    double time_s = 0.0;
    double snr_db = 0.0;
    bool too_faint = false;  ///< not measured: it lies somewhere below
  };
  std::vector<Measurement> measurements;

  /// An order that came, a rule that acted, a state that the mission went into, or another process that went on with it.
  struct Event {
    double time_s = 0.0;
    std::string what;
  };
  std::vector<Event> events;
  /// The last answer to an order, which is given again as often as the order is sent.
  struct Answer {
    std::uint32_t issuer = 0;
    std::uint32_t number = 0;
    messages::CommandOutcome outcome{};
    std::string what;
    std::size_t event = 0;  ///< its place among `events`
    std::size_t times = 1;
  };
  std::optional<Answer> last_answer;

  std::optional<std::string> safety_record;  ///< what that says which stands beside the journal

  double ended_s = 0.0;                                             ///< of the last record
  messages::MissionState state = messages::MissionState::kStandby;  ///< the last
  messages::EndReason end_reason = messages::EndReason::kNone;
  std::optional<std::string> ending_rule;  ///< the safety rule that ended it, in words with its evidence
  journal::AbortedBy aborted_by = journal::AbortedBy::kOperator;
  std::uint32_t steps_taken = 0;
  messages::Counters counters;           ///< the last
  search::SearchAccount account;         ///< of the last search
  std::optional<double> search_began_s;  ///< the first turn of the search
  std::optional<double> search_ended_s;  ///< the first turn after it

  /// Why its mission is over, in words: an abort of the program that was told to stop is not an operator's.
  [[nodiscard]] const char* why_it_ended() const;
  /// Its clock says UTC.
  [[nodiscard]] bool is_dated() const;
  /// How far it sailed while it searched.
  [[nodiscard]] Meters distance() const;
};

/// Makes a flight of the records of its journal, one after the other.
class SeaFlightReader {
 public:
  void take(const journal::Record& record);
  /// What the safety record beside the journal says.
  void note_safety_record(std::optional<std::string> words);
  /// Nothing: the journal does not begin with a mission.
  [[nodiscard]] const std::optional<SeaFlight>& flight() const { return flight_; }

 private:
  void add_event(std::string what);
  void note(const messages::Input& input);
  void note(const messages::Health& health);
  void note(const messages::CommandAcknowledgement& answer);
  void note(const messages::SafetyEvent& event);
  void note(const messages::JournalResumed& resumed);
  void note(const messages::Decision& decision);
  /// Files, set-points, troubles of a controller, and what cannot be read.
  template <class Content>
  void note(const Content& /*content*/) {}

  std::optional<SeaFlight> flight_;
  bool has_begun_ = false;
  double time_s_ = 0.0;
  double silence_s_ = 0.0;  ///< since the record before
};

/// Nothing when the journal does not begin with a mission. @throws host::BadInput naming the file when it cannot be read.
[[nodiscard]] std::optional<SeaFlight> read_sea_flight(const std::filesystem::path& journal);

}  // namespace earshot::report
