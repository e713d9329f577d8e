# What Cortex-M7 and Cortex-M4F have in common: no operating system (CMake's "Generic"), Debian's bare-metal compiler. Included by their files.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # a program needs a linker script
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY NEVER)
# Firmware without assertions: they would ask for stdio. At -O2, where -O3 makes the code half as large again.
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "C flags of the Release build type")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "C++ flags of the Release build type")
