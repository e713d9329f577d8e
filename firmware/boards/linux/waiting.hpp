#pragma once

#include <chrono>
#include <functional>
#include <iostream>
#include <string>

#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::board {

enum class Waited { kCame, kStopped, kInVain };

/// Whether waiting is announced: who started both processes knows of it.
enum class Notice { kGiven, kNone };

/// Waits for another process. Prints on standard error whom for and how long, when that takes more than a second and there is no --quiet,
/// and when it was in vain.
/// @param program  who waits
/// @param whom     "a simulator in DDS domain 50"
/// @param has_come  itself waits for the time that it is given, a tenth of a second
inline Waited wait_for(const std::string& program, const std::string& whom, std::chrono::seconds limit,
                       const std::function<bool(std::chrono::milliseconds)>& has_come, Notice notice = Notice::kGiven) {
  using std::chrono::steady_clock;
  const auto began = steady_clock::now();
  const std::string seconds = std::to_string(limit.count()) + " s";
  bool is_printed = notice == Notice::kNone || program::talk() == program::Talk::kQuiet;
  while (!has_come(std::chrono::milliseconds(100))) {
    if (program::stop_requested) return Waited::kStopped;
    const auto waited = steady_clock::now() - began;
    if (waited >= limit) {
      std::cerr << program << ": " << whom << " did not come within " << seconds << "\n";
      return Waited::kInVain;
    }
    if (is_printed || waited < std::chrono::seconds(1)) continue;
    std::cerr << program << ": waiting for " << whom << ", " << seconds << " at most\n";
    is_printed = true;
  }
  return Waited::kCame;
}

}  // namespace earshot::board
