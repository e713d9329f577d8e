#pragma once

#include <cstdint>

#include "firmware/boards/linux/can/trouble_watch.hpp"
#include "firmware/boards/linux/port/bus_trouble.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"

namespace earshot::board {

/// Tells of each trouble of a port when it begins and when it is over: owns the watch that finds them, and what was told last.
class TroubleReport {
 public:
  TroubleReport(std::uint8_t port, host::Roles roles, Duration oldest_part) : port_(port), watch_(roles, oldest_part) {}

  /// To be called whenever the bus has been read. Of a missing interface the link's own line tells; a controller that has left the bus says
  /// so here.
  /// @param is_up  the link is
  void check(bool is_up, const BusSigns& signs, TroubleWatch::Now now, InputSink& sink);

  /// Those that there ever were.
  [[nodiscard]] BusTroubles met() const { return met_; }

 private:
  std::uint8_t port_;
  TroubleWatch watch_;
  bool saw_bus_ = true;  ///< when it was last checked
  BusTroubles reported_;
  BusTroubles met_;
};

}  // namespace earshot::board
