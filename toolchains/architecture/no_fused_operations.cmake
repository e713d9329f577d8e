# Fails when Earshot's functions in a library fuse a multiplication with an addition. What flies gives the same bits on every machine because each of its
# operations is rounded by itself (-ffp-contract=off).
# usage: cmake -D OBJDUMP=objdump -D "LIBRARIES=a.a;b.a" -P no_fused_operations.cmake
cmake_minimum_required(VERSION 3.25)
if(NOT LIBRARIES)
  message(FATAL_ERROR "no libraries to look at")
endif()
foreach(library IN LISTS LIBRARIES)
  # vfmadd231ps, vfnmsub..., vfmaddsub... of x86-64; fmadd, fmsub, fnmadd, fmla, fmls, vfma, vfms, vfnma of ARM.
  execute_process(
    COMMAND ${OBJDUMP} -d --no-show-raw-insn ${library}
    COMMAND awk "/^[0-9a-f]+ <.*>:$/ {name = $2} name ~ /earshot/ && $2 ~ /^v?fn?m((add|sub|la|ls)[0-9a-z.]*|[as][.]f[0-9]+)$/ {print name, $2; found = 1; exit} END {exit !found}"
    OUTPUT_VARIABLE fused RESULTS_VARIABLE results)
  list(GET results 0 unreadable)
  list(GET results 1 none)
  if(NOT none)
    message(FATAL_ERROR "the fixed-memory core must not fuse operations: ${library}, ${fused}")
  elseif(unreadable OR NOT none EQUAL 1)
    message(FATAL_ERROR "cannot look at ${library}")
  endif()
endforeach()
