#pragma once

#include <optional>
#include <string>

#include "firmware/host/mission/mission_file.hpp"

namespace earshot::host {

// What becomes of a mission's ports where somebody other than its file has a say: a command line, or a simulation.

inline constexpr const char* kDefaultCanInterface = "can0";  ///< the bus of a vehicle at sea

/// What a command line says about the ports in place of the mission file.
struct PortOverride {
  std::optional<std::string> bus;  ///< "lcm", "can" (all over it) or "mixed" (navigation over CAN, the rest over LCM), whatever ports the
                                   ///< file has but a hydrophone's
  std::optional<std::string> lcm_url;                        ///< of every LCM port but a hydrophone's, which has a bus of its own
  std::optional<std::string> hydrophone_url = std::nullopt;  ///< of the hydrophone's port
  std::optional<std::string> can_interface;                  ///< of every CAN port
};

/// @throws host::BadInput when an LCM port would then share a hydrophone's bus, and for a name that no interface can have.
void override_ports(MissionFile& file, const PortOverride& given);

/// For a simulation that brings the SNR itself: what the hydrophone of a vehicle nearby hears is none of its business.
void leave_out_hydrophones(MissionFile& file);

/// For any simulation: an SNR on a CAN bus bears no date by which it could be told from this flight's, and one over LCM may copy a fix's.
void leave_snr_to_simulator(MissionFile& file);

}  // namespace earshot::host
