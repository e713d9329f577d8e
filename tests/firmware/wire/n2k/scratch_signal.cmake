# An own group does not compile with a signal of what is no field of a message, nor without one that a message's list has a place on the bus for: each is
# tried in a copy of a header that stands before the tree's own. As it is, the table compiles.
#   cmake -D ROOT=<checkout> -D COMPILER=<C++ compiler> -D FOLDER=<to work in> -P scratch_signal.cmake
cmake_minimum_required(VERSION 3.25)
set(source ${ROOT}/firmware/wire/n2k/signals.cpp)
set(groups firmware/wire/n2k/table/proprietary.hpp)
set(fields firmware/messages/dictionary/input_fields.hpp)

include(${ROOT}/tests/firmware/scratch_header.cmake)

# A member that no message has; one that the bus does not carry; a field whose line lost its place.
expect_refused(${groups} "&messages::Setpoint::depth" "&messages::Setpoint::draught" "draught")
expect_refused(${groups} "&messages::Setpoint::depth" "&messages::Setpoint::heading" "there_is_no_such_name")
expect_refused(${fields} ".bus = on_bus::number(\"Deaf\", 60, 2)" "" "there_is_no_such_name")
# A field that a group leaves out; one that got a place, of which no group knows.
expect_refused(${groups} "    signal_of<&messages::Setpoint::release_weight>(),\n" "" "carry_all_of<messages::Setpoint>")
expect_refused(${fields} "{.meaning = \"charge that is left; NaN: not known\"" "{.bus = on_bus::number(\"Charge\", 56, 8)"
  "carry_all_of<messages::VehicleStatus>")
message("every own group has the fields of its messages")
