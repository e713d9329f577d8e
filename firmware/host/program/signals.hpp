#pragma once

#include <atomic>
#include <cstdint>

namespace earshot::program {

/// Set when a person or a service manager asks the program to stop; see stop_on_signals().
inline std::atomic<bool> stop_requested{false};
// A signal handler sets it.
static_assert(std::atomic<bool>::is_always_lock_free);

enum class SecondSignal : std::uint8_t { kIgnored, kEndsAtOnce };

/// From now on the first SIGINT or SIGTERM sets stop_requested and does nothing else.
void stop_on_signals(SecondSignal second = SecondSignal::kIgnored);

/// From now on the end of the terminal or of the session that started the program (SIGHUP) does not end it.
void outlive_terminal();

}  // namespace earshot::program
