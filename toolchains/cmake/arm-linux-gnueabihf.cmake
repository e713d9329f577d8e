# 32-bit ARM: BeagleBone (Cortex-A8), and whatever is newer.
#
# Its NEON takes numbers below 2^-126 for zero, whatever the program asks for: float arithmetic with it has other bits than anywhere else. GCC therefore
# gives NEON whole numbers only, and computes with floats one by one in the VFP, which follows IEEE 754, unless -funsafe-math-optimizations (or
# -ffast-math) lets it: neither may ever stand here. -Wno-psabi: GCC would tell of what changed in its version 7. Files beyond 2 GB and days beyond 2038
# have 64 bits here, too.
# Source: GCC manual, "ARM Options", -mfpu.   Oracle: bits.bits, whose network is shown numbers as small as these, too
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(EARSHOT_ARCH armhf)
set(EARSHOT_TRIPLET arm-linux-gnueabihf)
include(${CMAKE_CURRENT_LIST_DIR}/arm-linux.cmake)
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-a8 -mfpu=neon -mfloat-abi=hard -Wno-psabi -D_FILE_OFFSET_BITS=64 -D_TIME_BITS=64")
set(CMAKE_C_FLAGS_INIT ${CMAKE_CXX_FLAGS_INIT})
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm;-cpu;cortex-a8;-L;${CMAKE_SYSROOT})
