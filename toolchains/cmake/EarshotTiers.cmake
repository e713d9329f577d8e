# Three tiers of tests, by ctest's labels: `unit` (in one process, under two minutes all together on two cores: tests/run --unit), `integration` (programs, scripts, buses) and
# `long`. Each test has one of them: of a GoogleTest program earshot_test sets it, of the other tests of a folder earshot_tiers.

# earshot_tier_of(RESULT NAME INTEGRATION LONG DEPENDS...): the label of the tests of a GoogleTest program.
function(earshot_tier_of RESULT NAME INTEGRATION LONG)
  set(tier unit)
  if(LONG)
    set(tier long)
  elseif(INTEGRATION OR "child_process" IN_LIST ARGN OR "private_network" IN_LIST ARGN)
    set(tier integration)
  elseif(NAME IN_LIST core_tests)
    set(tier "unit of the core")
  endif()
  set(${RESULT} ${tier} PARENT_SCOPE)
endfunction()

# earshot_tiers([LONG REGEX...]): at the end of a folder's CMakeLists.txt: of the tests that add_test has made there those whose names match are `long`, the others
# `integration`.
function(earshot_tiers)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "" "LONG")
  get_property(names DIRECTORY PROPERTY TESTS)
  foreach(name IN LISTS names)
    get_property(labels TEST ${name} PROPERTY LABELS)
    if(NOT labels MATCHES "unit|integration|long")
      set(tier integration)
      foreach(long IN LISTS ARG_LONG)
        if(name MATCHES "${long}")
          set(tier long)
        endif()
      endforeach()
      set_property(TEST ${name} APPEND PROPERTY LABELS ${tier})
    endif()
  endforeach()
endfunction()
