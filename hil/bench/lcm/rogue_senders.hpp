#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/authority/command_key.hpp"
#include "hil/bench/fault.hpp"
#include "hil/bench/lcm/keyed_mission.hpp"
#include "hil/nodes/lcm/message.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// Senders that should not be on an LCM bus, each while its fault acts.
class RogueSenders {
 public:
  /// Both must outlive it. @param vehicle  what is moving there
  RogueSenders(const std::vector<TimedFault>& faults, const vehicle::State& vehicle, std::uint64_t seed)
      : faults_(faults), vehicle_(vehicle), random_(seed, kStream) {}

  /// Adds what they say now; the time never goes back. @throws NoMaker of a fault of the bus that there is not over LCM
  void step(Time now, LcmMessages& sent);

 private:
  static constexpr std::uint64_t kStream = 7;
  /// @param passed_s  since the last step
  void send(const TimedFault& fault, Time now, double passed_s, LcmMessages& sent);
  /// Whole messages of a flood that are due. @param new_messages  since the last step
  [[nodiscard]] std::uint64_t due(double new_messages);

  const std::vector<TimedFault>& faults_;
  const vehicle::State& vehicle_;
  Pcg32 random_;
  std::optional<Time> last_;
  double owed_ = 0.0;  ///< messages of a flood
  std::uint32_t orders_ = 0;
  const host::CommandKey key_ = bench_key();
};

}  // namespace earshot::hil
