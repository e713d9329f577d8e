// Arm's MPS2 board with a Cortex-M7 (application note AN500), as QEMU has it: machine.hpp by its UART 0, its watchdog and 256 KiB that
// stand for flash.

#include "firmware/boards/cortex_m7/machine.hpp"

#include <array>
#include <atomic>

namespace earshot::machine {
namespace {

/// A register that only the machine's own bus sees.
volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uint32_t kClock_hz = 25'000'000;

// UART 0 of Arm's CMSDK (Cortex-M System Design Kit, DDI 0479, table 4-4).
constexpr std::uintptr_t kUart = 0x4000'4000;
constexpr std::uintptr_t kUartData = kUart + 0x00;
constexpr std::uintptr_t kUartState = kUart + 0x04;  ///< bit 0: the transmitter is full, 1: there is a byte, 3: one was lost
constexpr std::uint32_t kIsFull = 0x1;
constexpr std::uint32_t kHasByte = 0x2;
constexpr std::uint32_t kHasLost = 0x8;
constexpr std::uintptr_t kUartControl = kUart + 0x08;
constexpr std::uintptr_t kUartInterrupt = kUart + 0x0C;
constexpr std::uintptr_t kUartDivider = kUart + 0x10;
constexpr std::uint32_t kSendAndReceive = 0x3;
constexpr std::uint32_t kReceiveInterrupt = 0x8;
constexpr std::uint32_t kReceiveInterruptIsPending = 0x2;
constexpr std::uint32_t kBaud = 1'000'000;

// Its watchdog (table 4-13).
constexpr std::uintptr_t kWatchdogLoad = 0x4000'8000;
constexpr std::uintptr_t kWatchdogControl = 0x4000'8008;  ///< bit 0: counts and interrupts, 1: resets
constexpr std::uintptr_t kWatchdogClear = 0x4000'800C;
constexpr std::uintptr_t kWatchdogLock = 0x4000'8C00;
constexpr std::uint32_t kWatchdogKey = 0x1ACC'E551;

// The board's counter of its 25 MHz (application note AN500, table 3-6), divided to microseconds.
constexpr std::uintptr_t kMicroseconds = 0x4002'8018;
constexpr std::uintptr_t kPrescale = 0x4002'801C;

// SysTick (Armv7-M reference manual, B3.3): wakes the loop, so that it feeds the watchdog though nothing arrives.
constexpr std::uintptr_t kTickControl = 0xE000'E010;  ///< bit 0: counts, 1: interrupts, 2: by the processor's clock
constexpr std::uintptr_t kTickReload = 0xE000'E014;
constexpr std::uint32_t kTicks_per_s = 10;

constexpr std::uintptr_t kInterruptEnable = 0xE000'E100;  ///< NVIC_ISER0
constexpr std::uint32_t kUartReceives = 1U << 0U;         ///< interrupt 0

/// Bytes that have arrived and nobody has asked for: fixes and a kilohertz of sound of more than a quarter of a second, in which a decision
/// is made; full: the byte stays in the UART, which counts what is lost behind it.
constexpr std::size_t kRing = 2048;
struct Ring {
  std::array<std::uint8_t, kRing> bytes{};
  std::atomic<std::uint32_t> written{0};
  std::atomic<std::uint32_t> read{0};
  std::atomic<std::uint32_t> lost{0};
};
constinit Ring ring;

__attribute__((section(".store"))) std::array<std::uint8_t, std::size_t{256} * 1024> flash;

/// Moves the byte that the UART holds into the ring, if there is room. @return whether there is
bool take_byte() {
  const std::uint32_t written = ring.written.load(std::memory_order_relaxed);
  if (written - ring.read.load(std::memory_order_acquire) == kRing) return false;
  if ((at(kUartState) & kHasLost) != 0) {
    ring.lost.store(ring.lost.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    at(kUartState) = kHasLost;
  }
  ring.bytes[written % kRing] = static_cast<std::uint8_t>(at(kUartData));
  ring.written.store(written + 1, std::memory_order_release);
  return true;
}

}  // namespace

void begin() {
  at(kUartDivider) = kClock_hz / kBaud;
  at(kUartControl) = kSendAndReceive | kReceiveInterrupt;
  at(kInterruptEnable) = kUartReceives;
  at(kPrescale) = kClock_hz / 1'000'000 - 1;
  at(kTickReload) = kClock_hz / kTicks_per_s - 1;
  at(kTickControl) = 0x7;
}

std::size_t receive(std::span<std::uint8_t> bytes) {
  std::size_t count = 0;
  std::uint32_t read = ring.read.load(std::memory_order_relaxed);
  for (; count < bytes.size() && read != ring.written.load(std::memory_order_acquire); ++read) bytes[count++] = ring.bytes[read % kRing];
  ring.read.store(read, std::memory_order_release);
  // What waits in the UART since the ring was full makes no interrupt of its own.
  asm volatile("cpsid i" ::: "memory");
  while ((at(kUartState) & kHasByte) != 0 && take_byte()) {
  }
  at(kUartControl) = kSendAndReceive | kReceiveInterrupt;
  asm volatile("cpsie i" ::: "memory");
  return count;
}

std::uint32_t bytes_lost() {
  return ring.lost.load(std::memory_order_relaxed);
}

void send(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    while ((at(kUartState) & kIsFull) != 0) {
    }
    at(kUartData) = byte;
  }
}

void begin_watchdog() {
  at(kWatchdogLock) = kWatchdogKey;
  at(kWatchdogLoad) = kWatchdog_s * kClock_hz / 2;  // it resets when it has counted down twice
  at(kWatchdogControl) = 0x3;
}

void feed_watchdog() {
  at(kWatchdogClear) = 1;
}

std::uint32_t microseconds() {
  return at(kMicroseconds);
}

/// With interrupts off a byte cannot come between the check and the halt, which a pending one ends all the same.
void wait_for_interrupt() {
  asm volatile("cpsid i" ::: "memory");
  if (ring.read.load(std::memory_order_relaxed) == ring.written.load(std::memory_order_relaxed)) asm volatile("wfi");
  asm volatile("cpsie i" ::: "memory");
}

std::span<std::uint8_t> store() {
  return flash;
}

}  // namespace earshot::machine

extern "C" void serial_line_interrupt() {
  using namespace earshot::machine;
  at(kUartInterrupt) = kReceiveInterruptIsPending;
  while ((at(kUartState) & kHasByte) != 0) {
    if (take_byte()) continue;
    at(kUartControl) = kSendAndReceive;  // until there is room
    return;
  }
}
