# How the sources of a test are compiled, on every machine: earshot_compile_as_test, earshot_test_headers, earshot_sources_of. (earshot_test itself: tests/CMakeLists.txt, and
# tests/cortex_m7/CMakeLists.txt for a machine without an operating system.)

include(EarshotTiers)

# Tests are compiled as many at a time as the core is, where a preset does not say how many.
if(NOT DEFINED EARSHOT_TESTS_TOGETHER)
  set(EARSHOT_TESTS_TOGETHER "${EARSHOT_TOGETHER}")
endif()

# earshot_compile_as_test(NAME [APART]): a fifth of a test's compiling would be optimising what it expects; what it tests is built as ever. (Of tests at -O3
# GCC 12 gives warnings that are not so, too.)
#   APART  its sources one by one: they give different things the same name
function(earshot_compile_as_test NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "APART" "" "")
  target_link_libraries(${NAME} PRIVATE earshot_flags)
  if(CMAKE_CROSSCOMPILING)
    target_compile_definitions(${NAME} PRIVATE EARSHOT_EMULATED)  # tests/firmware/emulated.hpp
  endif()
  if(EARSHOT_BARE_METAL)
    # GoogleTest cannot be had in ISO mode here. As in that mode, what a test computes is fused as little as what it tests.
    set_target_properties(${NAME} PROPERTIES CXX_EXTENSIONS ON)
    target_compile_options(${NAME} PRIVATE -O1 -ffp-contract=off)
  else()
    target_compile_options(${NAME} PRIVATE $<$<CONFIG:Dev,Release>:-O1>)
  endif()
  if(NOT ARG_APART)
    earshot_compile_together(${NAME} "${EARSHOT_TESTS_TOGETHER}")
  endif()
  # GCC 12 takes what it inlines of a precompiled std::string for code of ours that writes beyond its end, and it does not; clang warns, too.
  target_compile_options(${NAME} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>")
endfunction()

# earshot_test_headers(GTEST HEADER...): the target test_headers, which precompiles what nearly every test includes, with the target of GoogleTest that is named. It
# is read once a build: of fifteen tests from everywhere 26.3 s of processor time without, 16.1 with it (GCC 12). A test takes it with REUSE_FROM test_headers.
function(earshot_test_headers GTEST)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "// Made by toolchains/cmake/EarshotTests.cmake: CMake precompiles headers for a source.\n")
  add_library(test_headers OBJECT ${source})
  target_link_libraries(test_headers PRIVATE ${GTEST})
  earshot_compile_as_test(test_headers)
  target_compile_options(test_headers PRIVATE "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")  # for ccache: the same bytes whenever they are made
  target_precompile_headers(test_headers PRIVATE ${ARGN})
endfunction()

# earshot_sources_of(RESULT LIBRARY...): the sources of libraries, to be compiled again in this folder with other flags, their own ones after them.
function(earshot_sources_of RESULT)
  set(sources "")
  foreach(library IN LISTS ARGN)
    get_target_property(of_library ${library} SOURCES)
    list(FILTER of_library INCLUDE REGEX "\\.cpp$")
    get_target_property(folder ${library} SOURCE_DIR)
    foreach(source IN LISTS of_library)
      foreach(property COMPILE_OPTIONS SKIP_UNITY_BUILD_INCLUSION)
        get_source_file_property(own ${folder}/${source} TARGET_DIRECTORY ${library} ${property})
        if(own)
          set_source_files_properties(${folder}/${source} PROPERTIES ${property} "${own}")
        endif()
      endforeach()
      list(APPEND sources ${folder}/${source})
    endforeach()
  endforeach()
  set(${RESULT} ${sources} PARENT_SCOPE)
endfunction()
