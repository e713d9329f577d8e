// A simulator's samples, as the link hands them to a runtime.
//
// The input is a row of ticks, each: how much later it comes (1 byte, 100 ms each), what is spoilt (see spoil()) of the bytes of its
// fields: number, date, counts, SNR (8 each), whether there is one, whether it is too faint, the order (1 each); of the
// bearing its direction, deviation and axis (8 each), whether there is one, and whether it is ambiguous (1 each).

#include <array>
#include <bit>
#include <optional>

#include "sim/link/lock_step_clock.hpp"
#include "tests/fuzz/targets/flown_runtime.hpp"

namespace earshot::fuzz {
namespace {

/// Of a good tick; numbers as they lie in memory.
link::Tick tick_in(Input& input, std::uint64_t number, Time time) {
  std::array<std::uint8_t, 69> bytes{};
  bytes[41] = number == 1 ? 1 : 0;  // START
  spoil(bytes, input);
  const auto word = [&bytes](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 8; ++i) value |= std::uint64_t{bytes[at + i]} << (8U * i);
    return value;
  };
  link::Tick tick;
  tick.number = number ^ word(0);
  tick.time = {time.us ^ static_cast<std::int64_t>(word(8))};
  tick.navigation_messages = word(16);
  tick.hydrophone_blocks = word(24);
  if (bytes[40] % 2 == 0) tick.snr = Decibels{std::bit_cast<double>(word(32))};
  tick.command = bytes[41];
  tick.snr_too_faint = bytes[42] % 2 == 1;
  const auto angle = [&word](std::size_t at) { return Radians{std::bit_cast<double>(word(at))}; };
  if (bytes[67] % 2 == 1)
    tick.bearing = messages::Bearing{
        .direction = angle(43), .deviation = angle(51), .mirror_axis = bytes[68] % 2 == 1 ? std::optional(angle(59)) : std::nullopt};
  return tick;
}

class Sink final : public board::InputSink {
 public:
  explicit Sink(FlownRuntime& runtime) : runtime_(runtime) {}
  void take(std::uint8_t /*port*/, const Value& value) override { runtime_.take(value, {}); }

 private:
  FlownRuntime& runtime_;
};

}  // namespace

void judge(std::span<const std::uint8_t> bytes) {
  FlownRuntime runtime;
  std::uint64_t number = 0;
  for (Input input(bytes); !input.is_used_up();) {
    const Duration later = Duration::milliseconds(100 * input.byte());
    runtime.take(dated<messages::Navigation>(runtime.now() + later), later);
    Sink sink(runtime);
    link::give_inputs(tick_in(input, ++number, runtime.now()), 0, sink);
    static_cast<void>(runtime.step());
  }
}

}  // namespace earshot::fuzz
