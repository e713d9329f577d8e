#include "tests/firmware/boards/cortex_m7/fake_machine.hpp"

#include "firmware/boards/cortex_m7/machine.hpp"
#include "firmware/boards/cortex_m7/stack.hpp"

namespace earshot {
namespace machine {

Fake& fake() {
  static Fake one;
  return one;
}

void send(std::span<const std::uint8_t> bytes) {
  fake().sent.insert(fake().sent.end(), bytes.begin(), bytes.end());
}
std::uint32_t bytes_lost() {
  return 0;
}
void begin_watchdog() {
  fake().has_watchdog = true;
}
void feed_watchdog() {
  ++fake().fed;
}
std::uint32_t microseconds() {
  return 0;
}
std::span<std::uint8_t> store() {
  return fake().store;
}

}  // namespace machine

namespace stack {

std::size_t size() {
  return 1000;
}
std::size_t most_used() {
  return 100;
}

}  // namespace stack
}  // namespace earshot
