# Fails when a static library of the fixed-memory core keeps anything between calls: all state lies in runtime::Runtime, and a function-local static
# is a variable that lives somewhere else.
#   cmake -D NM=nm "-D LIBRARIES=a.a;b.a" -P no_static_state.cmake
cmake_minimum_required(VERSION 3.25)
# Of lcm-gen: a message type's fingerprint, computed when it is first needed and the same ever after.
set(allowed "_Z(GV)?ZN7earshot[0-9]+[a-z_]+_t7getHashEvE4hash")

if(NOT LIBRARIES)
  message(FATAL_ERROR "no libraries to look at")
endif()
set(found "")
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} --defined-only --format=sysv ${library} OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0 OR NOT output MATCHES "[|][.]text")
    message(FATAL_ERROR "${NM} finds no code in ${library}")
  endif()
  # Constants that hold addresses (.data.rel.ro) can be written by the program loader only.
  string(REGEX MATCHALL "[^\n|]+[|][^\n]*[|]([.](data|bss|tdata|tbss)|[*]COM[*])[^\n]*" variables "${output}")
  list(FILTER variables EXCLUDE REGEX "[|][.]data[.]rel[.]ro")
  foreach(variable IN LISTS variables)
    string(REGEX REPLACE "[ |].*" "" variable "${variable}")
    if(NOT variable MATCHES "^${allowed}$")
      string(APPEND found "\n  ${library}: ${variable}")
    endif()
  endforeach()
endforeach()
if(found)
  message(FATAL_ERROR "the fixed-memory core must not keep:${found}")
endif()
