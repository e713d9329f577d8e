#include "firmware/safety/standing_alarm.hpp"

#include "firmware/config/capacities.hpp"

namespace earshot::safety {

static_assert(config::kMaxPorts < 32, "a bit for each port");

void StandingAlarm::take(Time arrival, std::uint8_t port, bool is_reported) {
  const std::uint32_t its_bit = std::uint32_t{1} << (port % 32U);
  if (is_reported) {
    stands_for_good_ = stands_for_good_ || (was_taken_back_ && arrival - taken_back_ <= kDrop);
    reported_by_ |= its_bit;
  } else if ((reported_by_ & its_bit) != 0) {
    reported_by_ &= ~its_bit;
    taken_back_ = arrival;
    was_taken_back_ = true;
  }
}

void StandingAlarm::begin() {
  was_taken_back_ = false;
  stands_for_good_ = false;
}

}  // namespace earshot::safety
