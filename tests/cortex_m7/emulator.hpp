#pragma once

#include <cstdint>

namespace earshot::emulator {

// What a program in QEMU can ask of it without a C library: Arm's semihosting.

/// @param text  ends with a zero
void print(const char* text);
void print_number(std::int64_t number);
/// Says "exit status N" and ends the emulator.
[[noreturn]] void end(int status);

/// Instructions since the first call, where the emulator counts time by them (-icount shift=6: one takes 64 ns). The processor's own work
/// alone is counted: no caches, no waiting for memory.
[[nodiscard]] std::uint32_t instructions();

}  // namespace earshot::emulator
