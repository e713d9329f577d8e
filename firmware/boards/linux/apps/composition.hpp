#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/core/board_core.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

// What earshotd puts together in the same way at sea, in simulation and for the checklist (run_modes.hpp).

/// The mission of a command line, with what its options say in place of the mission's own words. Its ports are not judged yet.
/// @throws host::BadInput naming file and key, or an option that a signed mission does not allow
[[nodiscard]] host::MissionFile load_mission(const Options& o, host::MissionVerifier& verifier);

/// Likewise with the ports that a vehicle at sea needs, which a signed mission brings along.
[[nodiscard]] host::MissionFile load_mission_for_sea(const Options& o, host::MissionVerifier& verifier);

/// @throws host::BadInput when the policy does not fit the mission
[[nodiscard]] std::unique_ptr<runtime::Runtime> make_runtime(const host::MissionFile& file, const host::SignedSearch& search,
                                                             const std::string& mission_name);

/// The board that decides in this program's place; null: none is named. The mission must fit this build, too: its refusals name file and
/// key. @param patience  with its answers
[[nodiscard]] std::unique_ptr<BoardCore> make_board(const Options& o, const host::MissionFile& file, const host::SignedSearch& search,
                                                    std::chrono::seconds patience);

/// Says which links are down, and gives the others a second: in lock-step with a simulator the first set-point is waited for.
void settle(PortSet& ports);

/// Waits until the clock runs. @param whose  who drives it; empty: this host
/// @return exit status, when it does not come; nothing: it has
[[nodiscard]] std::optional<int> wait_for_clock(const Options& o, const std::string& whose, Clock& clock);

}  // namespace earshot::board
