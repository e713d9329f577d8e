// tests/bits on a microcontroller: exit status 0 when all bits are those that were recorded.

#include <array>
#include <bit>
#include <cstddef>
#include <new>

#include "tests/bits/mission.hpp"
#include "tests/cortex_m7/emulator.hpp"

namespace {

using namespace earshot;

/// Made in main(), not before it: what a constructor could write at compile time would lie in flash a second time.
alignas(bits::Mission) std::array<std::byte, sizeof(bits::Mission)> room;

}  // namespace

int main() {
  using emulator::print;
  auto& mission = *new (room.data()) bits::Mission;
  if (mission.begin(bits::Track::kRecorded) != Status::kOk) {
    print("the core refuses the mission\n");
    emulator::end(2);
  }
  bits::Line line;
  bool is_same = true;
  for (std::size_t number = 0; is_same && !line.is_end; ++number) {
    line = mission.fly();
    is_same = bits::is_as_recorded(number, line);
    print(line.is_end ? "end " : "step ");
    emulator::print_number(line.is_end ? line.second : static_cast<std::int64_t>(line.step));
    print(", digest ");
    emulator::print_number(line.digest);
    print(is_same ? "\n" : " differs from what was recorded\n");
  }
  emulator::end(is_same ? 0 : 1);
}
