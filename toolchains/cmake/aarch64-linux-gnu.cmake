# Builds for 64-bit ARM with Debian's cross compiler, and runs what was built under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64;-L;/usr/aarch64-linux-gnu)
# Libraries of this machine's own kind are of no use; Eigen and GoogleTest's source are the same for all.
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY NEVER)
