# Fails when a static library of the fixed-memory core keeps anything between calls: all state lies in runtime::Runtime, and a function-local static
# is a variable that lives somewhere else.
#   cmake -D NM=nm "-D LIBRARIES=a.a;b.a" -P no_static_state.cmake
cmake_minimum_required(VERSION 3.25)

if(NOT LIBRARIES)
  message(FATAL_ERROR "no libraries to look at")
endif()
set(found "")
set(has_code OFF)
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} --defined-only --format=sysv ${library} OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0 OR NOT output MATCHES "[[][^]]+[.]o[]]")
    message(FATAL_ERROR "${NM} finds no object in ${library}")
  endif()
  if(output MATCHES "[|][.]text")
    set(has_code ON) # one library alone may have none: messages are headers, and what the compiler checks of them
  endif()
  # Constants that hold addresses (.data.rel.ro) can be written by the program loader only.
  string(REGEX MATCHALL "[^\n|]+[|][^\n]*[|]([.](data|bss|tdata|tbss)|[*]COM[*])[^\n]*" variables "${output}")
  list(FILTER variables EXCLUDE REGEX "[|][.]data[.]rel[.]ro")
  foreach(variable IN LISTS variables)
    string(REGEX REPLACE "[ |].*" "" variable "${variable}")
    string(APPEND found "\n  ${library}: ${variable}")
  endforeach()
endforeach()
if(NOT has_code)
  message(FATAL_ERROR "${NM} finds no code")
endif()
if(found)
  message(FATAL_ERROR "the fixed-memory core must not keep:${found}")
endif()
