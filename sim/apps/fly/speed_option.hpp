#pragma once

#include <optional>
#include <string>

#include "firmware/host/program/command_line.hpp"

namespace earshot::fly {

inline constexpr const char* kSpeedsAllowed = "0 or 0.001 to 1000000";

/// What is wrong with a value of --speed, simulated seconds per second; empty when nothing is. A wait of more than 292 years does not fit
/// the clock.
[[nodiscard]] inline std::string speed_complaint(const std::string& text) {
  const std::optional<double> speed = program::finite_number(text);
  const bool allowed = speed && (*speed == 0.0 || (*speed >= 1e-3 && *speed <= 1e6));
  return allowed ? std::string() : text + ": must be 0 or a number from 0.001 to 1000000";
}

}  // namespace earshot::fly
