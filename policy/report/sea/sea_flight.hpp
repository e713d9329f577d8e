#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/health.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {

/// A flight as its vehicle journalled it, without a simulator's files: at sea nobody else knows where it went. Times are seconds since the
/// journal's first record.
struct SeaFlight {
  double began_s = 0.0;  ///< when the journal begins, on the mission's clock: at sea seconds since 1970 in UTC
  Rectangle area;        ///< where it was to search
  Decibels threshold;    ///< of a detection
  Meters depth;          ///< of the search
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
    std::int32_t issuer = 0;
    std::int32_t number = 0;
    std::int8_t outcome = 0;
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
  bool is_stopped = false;                 ///< by a signal to its program, before it was over
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

/// Nothing when the journal does not begin with a mission. @throws host::BadInput naming the file when it cannot be read.
[[nodiscard]] std::optional<SeaFlight> read_sea_flight(const std::filesystem::path& journal);

/// "2026-11-22 15:04:05 UTC"
[[nodiscard]] std::string utc(double seconds_since_1970);

}  // namespace earshot::report
