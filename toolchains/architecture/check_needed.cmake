# What is installed on a vehicle needs no simulation middleware, and nothing of LCM's or CAN's libraries.
#   cmake -D PROGRAM=<earshotd> -D READELF=<readelf> -P check_needed.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${READELF} -d ${PROGRAM} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "NEEDED")
  message(FATAL_ERROR "${PROGRAM}: no NEEDED entry at all: is this a program?")
endif()
if(dynamic MATCHES "NEEDED[^\n]*(ddsc|liblcm|netcdf|hdf5|mpi)")
  message(FATAL_ERROR "${PROGRAM} must not need ${CMAKE_MATCH_0}")
endif()
