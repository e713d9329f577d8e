#pragma once

#include <string>

#include "firmware/boards/linux/input_sink.hpp"
#include "firmware/boards/linux/journal.hpp"
#include "firmware/boards/linux/vehicle_bus.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// One turn of the decision loop, the same at sea and in simulation: inputs are journalled and given to the runtime in the order in which
/// they come; the call makes the step, journals what comes out, and puts it on the bus.
///
/// In the journal a turn is: its inputs, each with the time at which it was taken, then set-point, decision if there is one, health, with
/// the turn's time. A reader can thus give the runtime the same inputs in the same order at the same times again, and step it at every
/// set-point.
class MissionTurn final : public InputSink {
 public:
  /// All three must outlive it.
  MissionTurn(runtime::Runtime& runtime, VehicleBus& bus, Journal& journal) : runtime_(runtime), bus_(bus), journal_(journal) {}

  void take(Time now, const runtime::Navigation& navigation) override;
  void take(Time now, const runtime::SnrEstimate& estimate) override;
  void take(Time now, runtime::OperatorCommand command) override;

  runtime::Outputs operator()(Time now);

 private:
  void record(Time now, const runtime::Outputs& outputs);

  runtime::Runtime& runtime_;
  VehicleBus& bus_;
  Journal& journal_;
};

/// "DONE, the source is reached, after 37 steps"
[[nodiscard]] std::string in_words(const runtime::Outputs& outputs);

}  // namespace earshot::board
