#include "tests/cortex_m7/emulator.hpp"

#include <array>
#include <cstddef>

namespace earshot::emulator {
namespace {

// Arm, Semihosting for AArch32 and AArch64, release 2.0.
constexpr std::uint32_t kWriteText = 0x04;
constexpr std::uint32_t kEnd = 0x18;
constexpr std::uintptr_t kApplicationExit = 0x20026;

/// The operation in the first register, its argument in the second, as a call has them.
__attribute__((naked)) void call(std::uint32_t /*operation*/, std::uintptr_t /*argument*/) {
  asm volatile("bkpt 0xAB\n bx lr");
}

/// The board's counter of its 25 MHz (application note AN500, table 3-6), undivided.
volatile std::uint32_t& counter() {
  return *reinterpret_cast<volatile std::uint32_t*>(0x4002'8018);
}
volatile std::uint32_t& prescale() {
  return *reinterpret_cast<volatile std::uint32_t*>(0x4002'801C);
}

}  // namespace

void print(const char* text) {
  call(kWriteText, reinterpret_cast<std::uintptr_t>(text));
}

void print_number(std::int64_t number) {
  std::array<char, 24> text{};
  std::size_t at = text.size() - 1;
  const bool is_negative = number < 0;
  auto left = static_cast<std::uint64_t>(is_negative ? -number : number);
  do {
    text[--at] = static_cast<char>('0' + left % 10);
    left /= 10;
  } while (left > 0);
  if (is_negative) text[--at] = '-';
  print(text.data() + at);
}

void end(int status) {
  print("exit status ");
  print_number(status);
  print("\n");
  call(kEnd, kApplicationExit);
  for (;;) {
  }
}

/// The counter's 32 bits are all used after 2.7e9 instructions; from one call to the next there must be fewer.
std::uint32_t instructions() {
  static std::uint32_t last = 0;
  static std::uint64_t ticks = 0;
  prescale() = 0;
  const std::uint32_t now = counter();
  ticks += now - last;
  last = now;
  return static_cast<std::uint32_t>(ticks * 10 / 16);  // 40 ns a tick, 64 ns an instruction
}

}  // namespace earshot::emulator
