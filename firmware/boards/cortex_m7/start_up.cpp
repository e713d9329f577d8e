// From reset to main(): the vector table, the floating-point unit, the stack painted, variables as they are to begin.

#include <cstddef>
#include <cstdint>

#include "firmware/boards/cortex_m7/stack.hpp"

extern "C" {

// Of the linker script.
extern std::uint32_t start_of_data;
extern std::uint32_t end_of_data;
extern const std::uint32_t data_in_flash;
extern std::uint32_t start_of_zero;
extern std::uint32_t end_of_zero;
using Constructor = void (*)();
extern const Constructor __init_array_start[];
extern const Constructor __init_array_end[];

void make_ready();
/// An error that nobody handles, or abort(): the watchdog begins anew.
[[noreturn]] void stop_here();
/// Of the machine: a byte has arrived on the serial line.
void serial_line_interrupt();
/// Of the processor's own timer: it wakes.
void tick_interrupt();

/// Called through the vector table with the floating-point unit still off: until it is on, nothing may touch a register of it, not even
/// what a compiler puts before a function's first line.
__attribute__((naked, noreturn, used)) void reset_handler() {
  asm volatile(
      "ldr r0, =0xE000ED88 \n"  // CPACR: full access to coprocessors 10 and 11
      "ldr r1, [r0]        \n"
      "orr r1, r1, #0xF00000\n"
      "str r1, [r0]        \n"
      "dsb                 \n"
      "ldr r0, =end_of_stack\n"  // a boot loader may have left a stack of its own
      "msr msp, r0         \n"
      "isb                 \n"
      "bl make_ready       \n"
      "bl main             \n"
      "bl stop_here        \n");
}

void make_ready() {
  earshot::stack::paint();
  const std::uint32_t* from = &data_in_flash;
  for (std::uint32_t* to = &start_of_data; to != &end_of_data;) *to++ = *from++;
  for (std::uint32_t* to = &start_of_zero; to != &end_of_zero;) *to++ = 0;
  for (const Constructor* constructor = __init_array_start; constructor != __init_array_end; ++constructor) (*constructor)();
}

__attribute__((weak)) void stop_here() {
  for (;;) {
  }
}

/// What the standard library calls where it would throw. newlib's would bring a heap.
[[noreturn]] void abort() {
  stop_here();
}

__attribute__((weak)) void serial_line_interrupt() {}
__attribute__((weak)) void tick_interrupt() {}

/// The vector table: the stack, where to begin, the processor's own exceptions, and 160 interrupts of the machine, as many as any Cortex-M7
/// that is named in porting.md has. Whichever of them machine.cpp enables is the serial line's: it enables no other.
asm(R"(
  .section .vectors, "a", %progbits
  .global vectors
vectors:
  .word end_of_stack
  .word reset_handler
  .rept 5
  .word stop_here              @ NMI, hard fault, memory management, bus fault, usage fault
  .endr
  .word 0, 0, 0, 0
  .word stop_here              @ SVC
  .word stop_here              @ debug monitor
  .word 0
  .word stop_here              @ PendSV
  .word tick_interrupt
  .rept 160
  .word serial_line_interrupt
  .endr
  .text
)");

}  // extern "C"
