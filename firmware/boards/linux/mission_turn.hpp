#pragma once

#include <string>

#include "firmware/boards/linux/journal.hpp"
#include "firmware/boards/linux/vehicle_bus.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// One turn of the decision loop, the same at sea and in simulation: journal what goes in, step, journal what comes out, put it on the bus.
///
/// In the journal a turn is: its inputs, then set-point, decision if there is one, health; all with the turn's time. The set-point thus
/// ends the inputs of a turn, and a reader can give the runtime the same inputs at the same times again.
class MissionTurn {
 public:
  /// All three must outlive it.
  MissionTurn(runtime::Runtime& runtime, VehicleBus& bus, Journal& journal) : runtime_(runtime), bus_(bus), journal_(journal) {}

  runtime::Outputs operator()(Time now, const runtime::Inputs& inputs);

 private:
  void record(Time now, const runtime::Inputs& inputs);
  void record(Time now, const runtime::Outputs& outputs);

  runtime::Runtime& runtime_;
  VehicleBus& bus_;
  Journal& journal_;
};

/// "DONE, the source is reached, after 37 steps"
[[nodiscard]] std::string in_words(const runtime::Outputs& outputs);

}  // namespace earshot::board
