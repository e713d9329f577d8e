# Builds for a Cortex-M4F, which has a floating-point unit for float alone: libgcc computes in double, bit for bit as IEEE 754 says, and slowly.
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
set(processor "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16")
set(common "${processor} -fno-math-errno -ffunction-sections -fdata-sections -Wno-psabi")
set(CMAKE_C_FLAGS_INIT "${common}")
set(CMAKE_CXX_FLAGS_INIT "${common}")
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,--defsym=no_unit_for_double=1) # see firmware/boards/cortex_m7/no_heap.ld
