#pragma once

#include <cstdint>

#include "firmware/boards/linux/clock/clock.hpp"

namespace earshot::board {

/// Mission time that a test sets.
class SetClock : public Clock {
 public:
  [[nodiscard]] Time now() override { return time; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc; }
  [[nodiscard]] Time arrival_of(Time utc) override { return utc; }
  [[nodiscard]] Wake wait(const Awaited& /*awaited*/) override { return Wake::kTurn; }
  [[nodiscard]] bool answered(const runtime::Outputs& /*outputs*/, std::uint64_t /*sent*/) override { return true; }
  Time time{1'795'000'000'000'000};
};

}  // namespace earshot::board
