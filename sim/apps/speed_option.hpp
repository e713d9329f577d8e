#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace earshot::simulation {

/// Of --speed: 0, or a thousandth to a million of simulated seconds per second. CLI::Range lets NaN pass, and a wait of more than 292 years
/// does not fit the clock.
inline CLI::Validator speed_range() {
  const auto check = [](const std::string& text) {
    double speed = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, speed);
    const bool allowed = is_number && (speed == 0.0 || (speed >= 1e-3 && speed <= 1e6));
    return allowed ? std::string() : text + ": must be 0 or a number from 0.001 to 1000000";
  };
  return {check, "0 or 0.001 to 1000000", "speed_range"};
}

}  // namespace earshot::simulation
