# A value of an enum that has no words does not compile: each enum that a message bears is given one more, in a copy of its header that stands before the
# tree's own. As it is, all of it compiles.
#   cmake -D ROOT=<checkout> -D COMPILER=<C++ compiler> -D FOLDER=<to work in> -P scratch_value.cmake
cmake_minimum_required(VERSION 3.25)
set(source ${ROOT}/firmware/messages/dictionary/complete.cpp)

function(compile RESULT OUTPUT)
  execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -I ${FOLDER} -I ${ROOT} ${source} RESULT_VARIABLE result ERROR_VARIABLE output)
  set(${RESULT} "${result}" PARENT_SCOPE)
  set(${OUTPUT} "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
compile(result output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the dictionary as it is does not compile:\n${output}")
endif()

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
  file(READ ${ROOT}/${header} text)
  string(REPLACE "${last}" "${last}, kScratch" changed "${text}")
  if(changed STREQUAL text)
    message(FATAL_ERROR "${header} has no ${last}: its last value is another by now; say it here")
  endif()
  file(REMOVE_RECURSE ${FOLDER})
  file(WRITE ${FOLDER}/${header} "${changed}")
  compile(result output)
  if(result EQUAL 0)
    message(FATAL_ERROR "a value of ${enum} without words compiles")
  elseif(NOT output MATCHES "has_all_words<${enum}>")
    message(FATAL_ERROR "a value of ${enum} without words does not compile, but not for that:\n${output}")
  endif()
endforeach()
message("no value without words compiles")
