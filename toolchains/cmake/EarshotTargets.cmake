# How an Earshot target is made: earshot_library (of the fixed-memory core with FIRMWARE), earshot_program. (earshot_test: tests/CMakeLists.txt.)
# Flags hang on targets through the interface targets below; nothing is set globally except the language standard and the output folders.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

# Where an installation has what; the rest of its rules: toolchains/packages.
include(GNUInstallDirs)
set(EARSHOT_INSTALL_PROGRAMS ${CMAKE_INSTALL_BINDIR})
set(EARSHOT_INSTALL_PLUGINS lib/earshot)    # firmware/host/file/shipped.hpp looks there, from the programs
set(EARSHOT_INSTALL_DATA share/earshot)     # as well; laid out as the source tree
set(EARSHOT_INSTALL_LIBRARIES ${CMAKE_INSTALL_LIBDIR}/earshot)
set(EARSHOT_INSTALL_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/earshot)

# Dev: as fast to debug as it can be while tests still fly whole missions; assertions stay on.
# (project() has made both cache entries already, empty.)
foreach(language C CXX)
  if(NOT CMAKE_${language}_FLAGS_DEV)
    set(CMAKE_${language}_FLAGS_DEV "-O2 -g1" CACHE STRING "${language} flags of the Dev build type" FORCE)
    mark_as_advanced(CMAKE_${language}_FLAGS_DEV)
  endif()
endforeach()

set(EARSHOT_SANITIZE "" CACHE STRING "Sanitizers to build with, for example address,undefined")
option(EARSHOT_NAMES_NO_FOLDER "What is compiled does not say in which folder the tree stood (packages)" OFF)
if(EARSHOT_NAMES_NO_FOLDER)
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
endif()
option(EARSHOT_HARDENED "What is compiled looks after its stack and its buffers, as Debian's own programs do (packages)" OFF)
if(EARSHOT_HARDENED)
  add_compile_options(-fstack-protector-strong -D_FORTIFY_SOURCE=2)
endif()
option(EARSHOT_COVERAGE "Count which lines run (preset coverage)" OFF)
# Another compiler, or the same one at another level of optimisation, has warnings that ours has not: they must not keep a user from building.
# Presets made for who works on Earshot set it (dev, asan, clang, coverage); .ci/run and tests/machines, by the environment, for all that they build.
set(strict OFF)
if("$ENV{EARSHOT_WARNINGS_ARE_ERRORS}")
  set(strict ON)
endif()
option(EARSHOT_WARNINGS_ARE_ERRORS "A warning ends the build" ${strict})

# A machine without an operating system, chosen by its toolchain file (toolchains/cmake/cortex-m.cmake).
set(EARSHOT_BARE_METAL OFF)
if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(EARSHOT_BARE_METAL ON)
endif()
set(EARSHOT_CAPACITY_PROFILE "" CACHE STRING "kMicrocontroller: the core with the capacities of a microcontroller (firmware/config/capacities.hpp)")

# x86-64-v3 (AVX2, FMA) rather than -march=native: the same bits on every machine that has it, and safe to share in a compiler cache.
if(NOT CMAKE_CROSSCOMPILING)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_FLAGS "-O1")
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }" EARSHOT_HOST_IS_X86_64_V3)
  unset(CMAKE_REQUIRED_FLAGS)
endif()

add_library(earshot_flags INTERFACE)
target_include_directories(earshot_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
target_compile_options(earshot_flags INTERFACE
  # Clang's -Wdouble-promotion minds a float that is stored in a double as well, which loses nothing.
  -Wall -Wextra -Wpedantic -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion> -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
  -Wimplicit-fallthrough $<$<BOOL:${EARSHOT_WARNINGS_ARE_ERRORS}>:-Werror>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>>:-Wshadow>  # compiled together, sources hide what others have
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 finds overlaps in std::string that are not there (GCC bug 105651)
  # What runs on a vehicle is built for the architecture's baseline (EARSHOT_BASELINE, set for firmware and sim/link): a package built here runs on any
  # of its computers. The rest is for the machine it is built on.
  $<$<AND:$<BOOL:${EARSHOT_HOST_IS_X86_64_V3}>,$<NOT:$<BOOL:$<TARGET_PROPERTY:EARSHOT_BASELINE>>>>:-march=x86-64-v3>)
if(EARSHOT_CAPACITY_PROFILE)
  target_compile_definitions(earshot_flags INTERFACE EARSHOT_CAPACITY_PROFILE=${EARSHOT_CAPACITY_PROFILE})
endif()
if(EARSHOT_SANITIZE)
  target_compile_options(earshot_flags INTERFACE -fsanitize=${EARSHOT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(earshot_flags INTERFACE -fsanitize=${EARSHOT_SANITIZE})
endif()
if(EARSHOT_COVERAGE)
  # Several tests of a program run at once, and count into the same files.
  target_compile_options(earshot_flags INTERFACE --coverage -fprofile-update=atomic)
  target_link_options(earshot_flags INTERFACE --coverage)
endif()

# The decision path gives the same bits everywhere: no fused multiply-add, no exceptions, no run-time type information (design: fixed-memory core).
add_library(earshot_firmware_flags INTERFACE)
target_link_libraries(earshot_firmware_flags INTERFACE earshot_flags)
target_compile_options(earshot_firmware_flags INTERFACE -ffp-contract=off -fno-exceptions -fno-rtti -fno-threadsafe-statics -Walloca -Wvla)

define_property(TARGET PROPERTY EARSHOT_BASELINE INITIALIZE_FROM_VARIABLE EARSHOT_BASELINE)

# earshot_record_calls(TARGET): beside each of its objects GCC writes who calls whom and with how much stack (.ci), for core_calls.cmake. Calls at a
# function's end stay calls, so that a recursion is seen though the optimiser could make a loop of it. Without ccache, which does not keep these files.
# For a microcontroller the code stays what flies, calls at a function's end with it: its stack alone is asked for (tests/cortex_m7/check_budgets).
function(earshot_record_calls TARGET)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CROSSCOMPILING AND NOT EARSHOT_PYTHON)
    target_compile_options(${TARGET} PRIVATE -fcallgraph-info=su,da -fno-optimize-sibling-calls)
  elseif(EARSHOT_BARE_METAL)
    target_compile_options(${TARGET} PRIVATE -fcallgraph-info=su,da)
  else()
    return()
  endif()
  set_target_properties(${TARGET} PROPERTIES CXX_COMPILER_LAUNCHER "")
endfunction()

# earshot_compile_together(NAME COUNT): so many sources at a time, where COUNT is one. The same headers are read less often: a third to a half of the processor
# time. A source whose names others have, too, has SKIP_UNITY_BUILD_INCLUSION.
#   EARSHOT_TOGETHER        of the core's libraries, in builds that are made to be run once, on other machines; of all that the Python module is made of
#   EARSHOT_TESTS_TOGETHER  of tests; as many as of those, where it is not set
#   EARSHOT_APART           each alone all the same: tests/mutation reads in the build which sources a program has
function(earshot_compile_together NAME COUNT)
  if(COUNT AND NOT EARSHOT_APART)
    set_target_properties(${NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${COUNT})
  endif()
endfunction()

# earshot_headers_included_first(RESULT SOURCE...): headers, named as from this folder, that a source of the same name includes before anything else.
function(earshot_headers_included_first RESULT)
  set(headers)
  foreach(source IN LISTS ARGN)
    cmake_path(REPLACE_EXTENSION source LAST_ONLY .hpp OUTPUT_VARIABLE header)
    cmake_path(ABSOLUTE_PATH source)
    if(EXISTS ${source}) # not generated
      file(STRINGS ${source} include REGEX "^#include" LIMIT_COUNT 1)
      cmake_path(ABSOLUTE_PATH header OUTPUT_VARIABLE path)
      cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      if(include STREQUAL "#include \"${path}\"")
        list(APPEND headers ${header})
      endif()
    endif()
  endforeach()
  set(${RESULT} ${headers} PARENT_SCOPE)
endfunction()

# earshot_small_on_bare_metal(NAME): a library of what runs once a turn may take longer where flash is scarce.
function(earshot_small_on_bare_metal NAME)
  if(EARSHOT_BARE_METAL)
    target_compile_options(${NAME} PRIVATE -Os)
  endif()
endfunction()

# earshot_library(NAME [FIRMWARE] HEADERS ... [SOURCES ...] [DEPENDS ...])
#   FIRMWARE  part of the fixed-memory core: its flags, and its objects are checked for heap, state, recursion and stack (tests/firmware/runtime)
#   DEPENDS   public link dependencies
function(earshot_library NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "FIRMWARE" "" "HEADERS;SOURCES;DEPENDS")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "earshot_library(${NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(ARG_FIRMWARE)
    set(flags earshot_firmware_flags)
  else()
    set(flags earshot_flags)
  endif()
  if(ARG_SOURCES)
    add_library(${NAME} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    # The flags are for who builds Earshot, not for who links a library of it (earshot-dev).
    target_link_libraries(${NAME} PRIVATE $<BUILD_INTERFACE:${flags}> PUBLIC ${ARG_DEPENDS})
    target_include_directories(${NAME} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    if(ARG_FIRMWARE)
      earshot_record_calls(${NAME})
    endif()
    if(ARG_FIRMWARE OR EARSHOT_PYTHON)
      earshot_compile_together(${NAME} "${EARSHOT_TOGETHER}")
    endif()
  else()
    add_library(${NAME} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(${NAME} INTERFACE ${ARG_DEPENDS})
    target_include_directories(${NAME} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  endif()
  target_compile_features(${NAME} ${scope} cxx_std_20)
  # A header that its source includes first is compiled by it as if alone. The others are a set of their own, each of which CMake compiles alone
  # (CMAKE_VERIFY_INTERFACE_HEADER_SETS in the dev preset).
  earshot_headers_included_first(first ${ARG_SOURCES})
  set(alone ${ARG_HEADERS})
  list(REMOVE_ITEM alone ${first})
  set(with_source ${ARG_HEADERS})
  list(REMOVE_ITEM with_source ${alone})
  target_sources(${NAME} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${with_source})
  target_sources(${NAME} ${scope} FILE_SET alone TYPE HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${alone})
  set_target_properties(${NAME} PROPERTIES INTERFACE_HEADER_SETS_TO_VERIFY alone)
  if(ARG_FIRMWARE)
    set_property(GLOBAL APPEND PROPERTY EARSHOT_FIRMWARE_LIBRARIES ${NAME})
  endif()
  if(EARSHOT_INSTALLED_LIBRARIES)
    if(ARG_FIRMWARE)
      # Of a function in a header the linker keeps one copy, which may be the one that whoever links the library compiled: the same bits there, too.
      target_compile_options(${NAME} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
    endif()
    install(TARGETS ${NAME} EXPORT Earshot
      ARCHIVE DESTINATION ${EARSHOT_INSTALL_LIBRARIES} COMPONENT dev
      FILE_SET HEADERS DESTINATION ${EARSHOT_INSTALL_HEADERS} COMPONENT dev
      FILE_SET alone DESTINATION ${EARSHOT_INSTALL_HEADERS} COMPONENT dev)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    foreach(header IN LISTS ARG_HEADERS)
      cmake_path(SET path NORMALIZE "${folder}/${header}")
      cmake_path(GET path PARENT_PATH parent)
      cmake_path(GET path FILENAME name)
      set_property(GLOBAL APPEND_STRING PROPERTY EARSHOT_INSTALLED "${EARSHOT_INSTALL_HEADERS} ${parent} ${name}\n")
    endforeach()
  endif()
endfunction()

# What the two functions below make, without the tests: cmake --build --preset release --target programs.
add_custom_target(programs)

# earshot_program(NAME [COMPONENT <package>] SOURCES ... [DEPENDS ...]): an executable in build/<preset>/bin.
#   COMPONENT  the package that it is installed with: runtime, sil, tools or hil (toolchains/packages); left out, it is not installed
function(earshot_program NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "COMPONENT" "SOURCES;DEPENDS")
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "earshot_program(${NAME}): unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE earshot_flags ${ARG_DEPENDS})
  add_dependencies(programs ${NAME})
  if(ARG_COMPONENT)
    install(TARGETS ${NAME} RUNTIME DESTINATION ${EARSHOT_INSTALL_PROGRAMS} COMPONENT ${ARG_COMPONENT})
    set_property(GLOBAL APPEND_STRING PROPERTY EARSHOT_PROGRAMS "${ARG_COMPONENT} ${NAME}\n")
  endif()
endfunction()

# earshot_plugin(NAME COMPONENT <package> SOURCES ... [DEPENDS ...]): what a program loads, beside it in build/<preset>/bin; installed in lib/earshot.
function(earshot_plugin NAME)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "COMPONENT" "SOURCES;DEPENDS")
  add_library(${NAME} MODULE ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE earshot_flags ${ARG_DEPENDS})
  add_dependencies(programs ${NAME})
  set_target_properties(${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  install(TARGETS ${NAME} LIBRARY DESTINATION ${EARSHOT_INSTALL_PLUGINS} COMPONENT ${ARG_COMPONENT})
endfunction()
