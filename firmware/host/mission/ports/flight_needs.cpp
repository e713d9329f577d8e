#include "firmware/host/mission/ports/flight_needs.hpp"

#include <cstddef>
#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {

void require_ports_for_sea(const MissionFile& file, const std::filesystem::path& path) {
  for (const Role role : {Role::kNavigation, Role::kSnr, Role::kOperator, Role::kAutopilot}) {
    if (has_port_for(file.ports, role)) continue;
    const bool has_sound = role == Role::kSnr && has_port_for(file.ports, Role::kHydrophone);
    if (has_sound && file.hearing) continue;
    if (has_sound)
      throw BadInput(path.string() +
                     ": port: \"hydrophone\" brings sound, and no table [hydrophone] states how to measure an SNR in it: write " +
                     "one, or give a port that brings an SNR the role \"snr\"");
    throw BadInput(path.string() + ": port: no port has the role \"" + kRoleWords[static_cast<std::size_t>(role)] +
                   "\", without which a mission cannot be flown at sea");
  }
}

void require_hydrophone(const MissionFile& file, const std::filesystem::path& path) {
  if (!has_port_for(file.ports, Role::kHydrophone))
    throw BadInput("--hear: " + path.string() +
                   ": port: no port has the role \"hydrophone\", over which sound would come; hear_tone.toml and "
                   "hear_calls.toml in firmware/boards/linux/missions have one");
  if (!file.hearing) throw BadInput("--hear: " + path.string() + ": hydrophone: no table [hydrophone] states what is listened for");
}

}  // namespace earshot::host
