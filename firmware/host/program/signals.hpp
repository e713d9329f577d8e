#pragma once

#include <atomic>
#include <cstdint>

namespace earshot::program {

/// Set when a person or a service manager asks the program to stop; see stop_on_signals().
inline std::atomic<bool> stop_requested{false};
// A signal handler sets it.
static_assert(std::atomic<bool>::is_always_lock_free);

/// Set when a service manager, logrotate or a terminal that closes sends SIGHUP; see install_sighup_handler().
inline std::atomic<bool> has_hung_up{false};

enum class SecondSignal : std::uint8_t { kIgnored, kEndsAtOnce };

/// From now on the first SIGINT, SIGTERM or SIGQUIT sets stop_requested and does nothing else.
void stop_on_signals(SecondSignal second = SecondSignal::kIgnored);

/// From now on nothing ends or halts the program that nobody means to stop it by: the end of the terminal or session that started it
/// (SIGHUP), a slip of the keys (Ctrl-Z, SIGTSTP), a terminal that keeps background programs from it (SIGTTIN, SIGTTOU), a timer, a limit
/// of processor time, and signals that mean something to other programs only (SIGUSR1, SIGUSR2 and their like, real-time signals).
void ignore_unmeant_signals();

/// From now on SIGHUP sets stop_requested, too: the terminal that the program was started in is gone, and it has something to put in order.
void stop_on_sighup();

/// From now on SIGHUP sets has_hung_up and does nothing else.
void install_sighup_handler();

}  // namespace earshot::program
