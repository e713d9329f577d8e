#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace earshot::machine {

/// The microcontroller that a FlightBoard of a test runs on: machine.hpp and stack.hpp by this computer.
struct Fake {
  std::vector<std::uint8_t> sent;  ///< onto the line, and not looked at yet
  bool has_watchdog = false;
  std::size_t fed = 0;
  std::vector<std::uint8_t> store = std::vector<std::uint8_t>(std::size_t{256} * 1024);
};
[[nodiscard]] Fake& fake();

}  // namespace earshot::machine
