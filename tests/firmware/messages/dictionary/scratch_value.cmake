# A value of an enum that has no words does not compile: each enum that a message bears is given one more, in a copy of its header that stands before the
# tree's own. As it is, all of it compiles.
#   cmake -D ROOT=<checkout> -D COMPILER=<C++ compiler> -D FOLDER=<to work in> -P scratch_value.cmake
cmake_minimum_required(VERSION 3.25)
set(source ${ROOT}/firmware/messages/dictionary/complete.cpp)

include(${ROOT}/tests/firmware/scratch_header.cmake)

# ENUM, the header that has it, and its last value.
foreach(scratch
    "MissionState|firmware/messages/health.hpp|kAbort = 3"
    "EndReason|firmware/messages/health.hpp|kOutage = 11"
    "Authority|firmware/messages/health.hpp|kAbort = 4"
    "Order|firmware/messages/operator_command.hpp|kTighten = 7"
    "CommandOutcome|firmware/messages/operator_command.hpp|kObeyedNotDurable = 13"
    "Ending|firmware/messages/journal_records.hpp|kClockLost = 2"
    "ControllerState|firmware/messages/journal_records.hpp|kBusOff = 1"
    "BoardEvent|firmware/messages/board_report.hpp|kDecided = 4"
    "config::Response|firmware/config/safety.hpp|kRelease = 6"
    "config::Condition|firmware/config/safety.hpp|kSetpointsUnsent")
  string(REPLACE "|" ";" scratch ${scratch})
  list(GET scratch 0 enum)
  list(GET scratch 1 header)
  list(GET scratch 2 last)
  expect_refused(${header} "${last}" "${last}, kScratch" "has_all_words<${enum}>")
endforeach()
message("no value without words compiles")
