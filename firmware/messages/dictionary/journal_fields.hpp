#pragma once

#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::messages {

template <>
struct WordsOf<Ending> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<Ending>::name;
  static constexpr auto kTable = std::to_array<Word<Ending>>({
      {Ending::kMissionOver, "mission_over", "mission over", "the mission was over"},
      {Ending::kStopped, "stopped", "stopped", "the program was stopped"},
      {Ending::kClockLost, "clock_lost", "clock lost", "the simulator was gone"},
  });
};

template <>
struct WordsOf<ControllerState> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<ControllerState>::name;
  static constexpr auto kTable = std::to_array<Word<ControllerState>>({
      {ControllerState::kErrorPassive, "error_passive", "error passive", "the CAN controller counts many errors (error-passive)"},
      {ControllerState::kBusOff, "bus_off", "bus off", "the CAN controller has left the bus after too many errors (bus-off)"},
  });
};
/// What is said when that is over.
[[nodiscard]] constexpr std::string_view end_of(ControllerState trouble) {
  return trouble == ControllerState::kBusOff ? "the CAN controller is back on the bus" : "the CAN controller counts few errors";
}

template <>
struct Described<ClosingRecord> {
  static constexpr std::string_view kType = "journal_end_t";
  static constexpr std::string_view kChannel = "EARSHOT_JOURNAL_END";
  static constexpr std::string_view kMeaning =
      "The last record of a journal whose program ended in order: what the journal lacks, and how the flight stood.";
  static constexpr LineList kFields{
      field<&ClosingRecord::time>("utime", {.meaning = "of the last turn", .is_in_files = false}),
      field<&ClosingRecord::ending>("ending", {.meaning = "why the program ended", .values = FieldFormat::Values::kPlain}),
      field<&ClosingRecord::state>("state", {.meaning = "of the mission: health_t's"}),
      field<&ClosingRecord::end_reason>("end_reason", {.meaning = "health_t's"}),
      field<&ClosingRecord::steps_taken>("steps_taken"),
      field<&ClosingRecord::lost, &LostRecords::streams>(
          "streams_lost", {.meaning = "records that the disk did not take: navigation, SNR, reports, health"}),
      field<&ClosingRecord::lost, &LostRecords::steering>("steering_lost", {.meaning = "likewise set-points and decisions"}),
      field<&ClosingRecord::lost, &LostRecords::orders>(
          "orders_lost", {.meaning = "likewise mission, policy, commands, acknowledgements, changes of state"}),
  };
};

template <>
struct Described<JournalPart> {
  static constexpr std::string_view kType = "journal_part_t";
  static constexpr std::string_view kChannel = "EARSHOT_JOURNAL_PART";
  static constexpr std::string_view kMeaning = "A later part of a journal begins with it; it bears no record's number of its own.";
  static constexpr LineList kFields{
      field<&JournalPart::part>("part", {.meaning = "counted from 1: the second file has 2"}),
      field<&JournalPart::first_record_crc32>(
          "first_record_crc32", {.meaning = "of the journal's first record, as it stands there: which journal this is a part of"}),
  };
};

template <>
struct Described<JournalResumed> {
  static constexpr std::string_view kType = "journal_resumed_t";
  static constexpr std::string_view kChannel = "EARSHOT_JOURNAL_RESUMED";
  static constexpr std::string_view kMeaning =
      "Where another process went on with a mission from its journal: what stands before was written by one that was killed or lost its "
      "power.";
  static constexpr LineList kFields{
      field<&JournalResumed::time>("utime", {.is_in_files = false}),
      field<&JournalResumed::cut_bytes>(
          "cut_bytes", {.meaning = "behind what stands before: of a record that was never whole, or of a turn that is made again"}),
      text<&JournalResumed::build>("build", {.meaning = "version and commit of the program that goes on, padded with zeros"}),
  };
};

template <>
struct Described<ControllerTrouble> {
  static constexpr std::string_view kType = "controller_trouble_t";
  static constexpr std::string_view kChannel = "EARSHOT_CONTROLLER_TROUBLE";
  static constexpr std::string_view kMeaning =
      "The CAN controller of a port is in trouble from now on, or no longer: its kernel reported it. It steers nothing.";
  static constexpr LineList kFields{
      field<&ControllerTrouble::time>("utime", {.meaning = "microseconds on the mission clock", .is_in_files = false}),
      field<&ControllerTrouble::port>("port"),
      field<&ControllerTrouble::trouble>("trouble", {.values = FieldFormat::Values::kPlain}),
      field<&ControllerTrouble::is_there>("is_there", {.meaning = "false: it is over"}),
  };
};

}  // namespace earshot::messages
