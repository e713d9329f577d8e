# 64-bit ARM: every Raspberry Pi from the 3 on with a 64-bit system, Jetson. ARMv8-A's baseline, which all of them have; IEEE arithmetic, NEON with it.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(EARSHOT_ARCH aarch64)
set(EARSHOT_TRIPLET aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/arm-linux.cmake)
set(CMAKE_CXX_FLAGS_INIT "-march=armv8-a -mtune=cortex-a72")
set(CMAKE_C_FLAGS_INIT ${CMAKE_CXX_FLAGS_INIT})
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64;-L;${CMAKE_SYSROOT})
