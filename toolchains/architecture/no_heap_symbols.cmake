# Fails when a static library of the fixed-memory core needs anything from outside but what is listed here: so no heap, exceptions, stdio or libm.
# usage: cmake -DNM=nm "-DLIBRARIES=a.a;b.a" -P no_heap_symbols.cmake
set(allowed
  "_ZNK?7earshot.*"                    # the core itself
  "memcpy|memmove|memset|memcmp|bcmp"  # GCC and clang expect these of every environment, bare metal too
  "memchr|strlen|strcmp|strncmp"       # look at bytes and do nothing else; in every libc, bare metal too
  "__cpu_model|__cpu_indicator_init|_GLOBAL_OFFSET_TABLE_" # of libgcc and the linker, x86-64 Linux only: which instructions there are (firmware/core/wide.hpp)
  "__assert_fail"                      # Dev builds only: says where and ends the program
)

if(NOT LIBRARIES)
  message(FATAL_ERROR "no libraries to look at")
endif()
set(found "")
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} --undefined-only --format=posix ${library} OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} cannot read ${library}")
  endif()
  string(REGEX MATCHALL "[^\n]+ [Uwv] " symbols "${output}")
  foreach(symbol IN LISTS symbols)
    string(REGEX REPLACE " [Uwv] $" "" symbol "${symbol}")
    set(is_allowed FALSE)
    foreach(pattern IN LISTS allowed)
      if(symbol MATCHES "^(${pattern})$")
        set(is_allowed TRUE)
      endif()
    endforeach()
    if(NOT is_allowed)
      string(APPEND found "\n  ${library}: ${symbol}")
    endif()
  endforeach()
endforeach()
if(found)
  message(FATAL_ERROR "the fixed-memory core must not need:${found}")
endif()
