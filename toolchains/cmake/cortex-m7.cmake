# Builds for a Cortex-M7 with a floating-point unit for float and double (STM32H7, i.MX RT1062), bare metal.
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
set(processor "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16")
set(common "${processor} -fno-math-errno -ffunction-sections -fdata-sections -Wno-psabi")
set(CMAKE_C_FLAGS_INIT "${common}")
set(CMAKE_CXX_FLAGS_INIT "${common}")
