# What runs on a vehicle is built for the architecture's baseline: wider instructions only in functions that are chosen at run time, the copies that the
# compiler makes (firmware/core/wide.hpp) and those named ..._with_avx2 and ..._with_avx512 (firmware/policy/network.cpp).
#   cmake -D PROGRAM=<earshotd> -D OBJDUMP=<objdump> -P check_baseline.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(
  COMMAND ${OBJDUMP} -d --no-show-raw-insn ${PROGRAM}
  COMMAND awk "/^[0-9a-f]+ <.*>:$/ {name = $2} /^ *[0-9a-f]+:\tv[a-z0-9]+ / && name !~ /[.]avx2|_with_avx(2|512)/ {print name; found = 1; exit} END {exit !found}"
  OUTPUT_VARIABLE wide RESULT_VARIABLE none)
if(NOT none)
  message(FATAL_ERROR "${PROGRAM} uses AVX outside of what is chosen at run time, in ${wide}")
endif()
