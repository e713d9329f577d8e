// The program of a microcontroller that flies.

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include "firmware/boards/cortex_m7/flight_board.hpp"
#include "firmware/boards/cortex_m7/machine.hpp"

namespace {

/// Made in main(), not before it: what a constructor could write at compile time would lie in flash a second time.
alignas(earshot::board::FlightBoard) std::array<std::byte, sizeof(earshot::board::FlightBoard)> room;

}  // namespace

int main() {
  using namespace earshot;
  machine::begin();
  auto& board = *new (room.data()) board::FlightBoard;
  board.begin();
  std::array<std::uint8_t, 256> bytes;
  for (;;) {
    machine::feed_watchdog();
    const std::size_t count = machine::receive(bytes);
    if (count == 0) machine::wait_for_interrupt();
    board.take(std::span(bytes).first(count));
  }
}
