// Mission files: the input is the text of one.

#include <string>

#include "firmware/config/mission.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"

namespace earshot::fuzz {

void judge(std::span<const std::uint8_t> bytes) {
  const std::string path = EARSHOT_SOURCE_DIR "/firmware/boards/linux/missions/a.toml";
  try {
    const host::MissionFile file = host::load_mission(path, std::string(bytes.begin(), bytes.end()), host::VehicleTrust{});
    require(config::check(file.mission) == Status::kOk, "a mission was read that the runtime would not take");
    require(file.step_period.us > 0 && !file.ports.empty(), "a mission was read that cannot be flown");
  } catch (const host::BadInput& refusal) {
    require_names_file(refusal.what(), path);
  }
}

}  // namespace earshot::fuzz
