#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "firmware/wire/n2k/local_plane.hpp"
#include "hil/bench/fault.hpp"
#include "hil/nodes/device.hpp"
#include "hil/nodes/pace.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// Of the frames of a flood: it wins every arbitration, and is of a group that nobody has.
inline constexpr std::uint32_t kFloodIdentifier = 0;

/// Of a flood on a bus of 250 kbit/s: from so many frames a second on there is no bit left between them. One has 147 bits with its stuff
/// bits (146 to 151, by what it counts).
inline constexpr double kFullBus_frames_per_s = 1'700.0;

/// Nodes that should not be on the bus, each while its fault acts.
class RogueNodes {
 public:
  /// @param faults   of them those of who is on the bus; the interface is the flight's
  /// @param vehicle  what is moving there; must outlive it
  /// @throws NoMaker of a fault of the bus that there is not over CAN
  RogueNodes(const std::vector<TimedFault>& faults, const vehicle::State& vehicle, const n2k::LocalPlane& plane);

  /// Every frame on the bus that is not theirs.
  void accept(const n2k::Frame& frame, Time now);
  /// Adds what they say now.
  void step(Time now, Frames& frames);
  /// Whether a flood leaves no room on the bus: everybody else loses every arbitration.
  [[nodiscard]] bool fill_bus(Time now) const;

 private:
  struct RogueNode {
    TimedFault fault;
    std::unique_ptr<vehicle::State> believed = nullptr;  ///< of a second navigation
    std::unique_ptr<Device> device = nullptr;            ///< null: it has no place in the network
    Pace pace{Duration::seconds(1)};
  };
  void flood(double new_frames, Frames& frames);
  void give_old_order(Time now, Frames& frames);

  const vehicle::State& vehicle_;
  std::vector<RogueNode> rogue_nodes_;
  std::optional<Time> last_;
  double owed_frames_ = 0.0;
  std::uint32_t flooded_ = 0;
  std::uint8_t orders_ = 0;
};

}  // namespace earshot::hil
