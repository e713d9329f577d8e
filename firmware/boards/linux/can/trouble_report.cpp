#include "firmware/boards/linux/can/trouble_report.hpp"

#include <cstddef>

namespace earshot::board {

void TroubleReport::check(bool is_up, const BusSigns& signs, TroubleWatch::Now now, InputSink& sink) {
  const bool sees_bus = is_up || signs.controller == n2k::ControllerState::kBusOff;
  if (sees_bus && !saw_bus_) watch_.restart(signs, now);
  saw_bus_ = sees_bus;
  if (!sees_bus) return;
  const BusTroubles troubles = watch_.check(signs, now);
  const BusTroubles changed = troubles ^ reported_;
  for (std::size_t i = 0; i < kBusTroubleCount; ++i) {
    if (changed[i]) sink.report_trouble(port_, static_cast<BusTrouble>(i), troubles[i]);
  }
  reported_ = troubles;
  met_ |= troubles;
}

}  // namespace earshot::board
