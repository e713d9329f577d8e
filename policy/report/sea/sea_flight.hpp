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

  std::size_t fixes = 0;                            ///< of the vehicle's own navigation
  std::size_t measurements = 0;                     ///< of the SNR, as they came in
  std::optional<double> loudest_db = std::nullopt;  ///< of those that were not too faint
  Meters sailed{0.0};                               ///< while it searched

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
  void note(const messages::Input& input);
  void note(const messages::Health& health);
  void note(const messages::SafetyEvent& event);
  void note(const messages::Decision& decision);
  /// Files, answers, set-points, troubles of a controller, and what cannot be read.
  template <class Content>
  void note(const Content& /*content*/) {}

  std::optional<SeaFlight> flight_;
  bool has_begun_ = false;
  double time_s_ = 0.0;
  std::optional<NorthEast> place_;  ///< the last of this search
};

/// Nothing when the journal does not begin with a mission. @throws host::BadInput naming the file when it cannot be read.
[[nodiscard]] std::optional<SeaFlight> read_sea_flight(const std::filesystem::path& journal);

}  // namespace earshot::report
