#pragma once

#include "firmware/messages/board_report.hpp"
#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/dictionary/words.hpp"

namespace earshot::messages {

template <>
struct WordsOf<BoardEvent> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<BoardEvent>::name;
  static constexpr auto kTable = std::to_array<Word<BoardEvent>>({
      {BoardEvent::kStarted, "started", "started", "it has begun, and knows of no mission"},
      {BoardEvent::kArmed, "armed", "armed", "it has a mission, a policy and ocean tables"},
      {BoardEvent::kRefused, "refused", "refused", "it refuses what it was sent"},
      {BoardEvent::kInputsLost, "inputs_lost", "inputs lost", "fewer inputs have come than the turn counts"},
      {BoardEvent::kDecided, "decided", "decided", "it has decided"},
  });
};

template <>
struct Described<BoardReport> {
  static constexpr std::string_view kType = "board_t";
  static constexpr std::string_view kChannel = "EARSHOT_BOARD";
  static constexpr std::string_view kMeaning = "How a microcontroller that flies a mission is doing. On its serial line alone.";
  static constexpr LineList kFields{
      field<&BoardReport::time>("utime"),
      field<&BoardReport::event>("event", {.values = FieldFormat::Values::kPlain}),
      field<&BoardReport::status>("status", {.meaning = "Status of firmware/core/status.hpp; of REFUSED why"}),
      field<&BoardReport::frames_refused>("frames_refused", {.meaning = "torn on the line"}),
      field<&BoardReport::bytes_lost>("bytes_lost", {.meaning = "that arrived when there was no room"}),
      field<&BoardReport::turn_us>("turn_us", {.meaning = "that the last turn took, by the board's clock"}),
      field<&BoardReport::stack_bytes>("stack_bytes"),
      field<&BoardReport::stack_used_bytes>("stack_used_bytes", {.meaning = "at most, since the start"}),
  };
};

}  // namespace earshot::messages
