# What the presets for ARM Linux have in common: Debian's cross compiler, Debian's libraries of that machine (toolchains/sysroot), and qemu-user to run
# what was built. Included with EARSHOT_ARCH and EARSHOT_TRIPLET set.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${EARSHOT_TRIPLET}-gcc)
set(CMAKE_CXX_COMPILER ${EARSHOT_TRIPLET}-g++)
set(CMAKE_LIBRARY_ARCHITECTURE ${EARSHOT_TRIPLET})

get_filename_component(CMAKE_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroots/${EARSHOT_ARCH} ABSOLUTE)
if(NOT EXISTS ${CMAKE_SYSROOT}/made-of)
  message(FATAL_ERROR "${CMAKE_SYSROOT} is not there: toolchains/setup build ${EARSHOT_ARCH}")
endif()
# Programs run here; libraries, headers and packages are the other machine's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_DIR} "")
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/${EARSHOT_TRIPLET}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)
