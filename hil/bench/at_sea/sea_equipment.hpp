#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hil/bench/at_sea/kernel_counts.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/bench/case.hpp"
#include "hil/bus/serial/serial_adapter.hpp"
#include "hil/nodes/sound/sample_sender.hpp"

namespace earshot::hil {

/// What stands at sea between Earshot's computer and the vehicle, as far as a case lets a fault be injected into it: the CAN controller by
/// which it is on the bus, what the kernel does to the bus's frames, the hydrophone that sends samples.
class SeaEquipment {
 public:
  /// @throws NotFlown where this kernel cannot do what the case wants
  SeaEquipment(const Case& c, const Bench& bench);
  ~SeaEquipment();
  SeaEquipment(const SeaEquipment&) = delete;
  SeaEquipment& operator=(const SeaEquipment&) = delete;

  /// What earshotd's command line says of it.
  [[nodiscard]] std::vector<std::string> options_of_earshotd() const;
  /// @throws NoMaker of a fault of nothing that it has
  void begin(const TimedFault& fault);
  void end(const TimedFault& fault);
  /// Faults that the kernel has not counted, in words: they were not injected, or nobody could know.
  [[nodiscard]] std::vector<std::string> uncounted() const;

 private:
  [[nodiscard]] NetemCounts netem_now() const;  ///< so far

  const Case& case_;
  std::string bus_;
  std::string sound_url_;
  std::optional<SerialAdapter> adapter_;  ///< nothing: Earshot is on the bus itself
  std::optional<SampleSender> hydrophone_;
  bool has_netem_ = false;  ///< now
  NetemCounts netem_;       ///< of those that are over
};

}  // namespace earshot::hil
