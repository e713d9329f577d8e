#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::machine {

// All that the application asks of its computer. A board is a file that defines these functions, and a linker script: mps2_an500/ is one,
// and porting.md says what another takes.

/// Clocks and the serial line; called once, before anything else here.
void begin();

/// What has arrived on the serial line since the last call, the oldest first, until `bytes` is full.
/// @return how many bytes
[[nodiscard]] std::size_t receive(std::span<std::uint8_t> bytes);
/// Bytes that arrived when there was no room for them.
[[nodiscard]] std::uint32_t bytes_lost();

/// Puts bytes on the serial line, and waits while it takes no more.
void send(std::span<const std::uint8_t> bytes);

/// From now on the machine begins anew when nobody has told the watchdog for kWatchdog_s that the loop goes round. Again: nothing.
void begin_watchdog();
void feed_watchdog();
inline constexpr std::uint32_t kWatchdog_s = 10;

/// A clock that goes on from begin(), and begins anew after 71 minutes.
[[nodiscard]] std::uint32_t microseconds();

/// Halts until an interrupt, of which one comes at least ten times a second; not when something has arrived.
void wait_for_interrupt();

/// Memory for what is written once, before a mission, and read when it begins: a policy, its ocean tables, half of it each.
/// @return as many bytes as there are; the same ones every time
[[nodiscard]] std::span<std::uint8_t> store();

}  // namespace earshot::machine
