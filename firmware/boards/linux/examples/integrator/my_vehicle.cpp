// The process that flies a vehicle of one's own: earshotd's loop, journal and ports of the mission file, and beside these a
// serial_port.hpp.
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/core/core.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/open_ports.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/runtime/runtime.hpp"
#include "serial_port.hpp"

using namespace earshot;

int main(int argc, char** argv) try {
  if (argc != 4) throw std::invalid_argument("usage: my_vehicle MISSION SERIAL_LINE FOLDER");
  host::MissionVerifier verifier;  // takes a vehicle's configuration where signed missions alone may be flown
  const host::MissionFile mission = verifier.load_mission(argv[1]);
  host::require_named_files(mission);
  const host::SignedSearch search = verifier.load_search(mission);
  const auto runtime = std::make_unique<runtime::Runtime>();
  if (runtime->configure(mission.mission, *search.policy.policy, *search.tables.tables) != Status::kOk)
    throw std::invalid_argument("this mission cannot be flown with its policy");

  const board::HostClock host;
  board::HostMissionClock clock(host);
  board::PortSet ports;
  board::open_ports(mission, host, host::IfMissing::kKeepTrying, board::WakesFor::kMeasurements, ports);
  ports.add(std::make_unique<SerialPort>(ports.next_index(), argv[2]));

  std::filesystem::create_directories(argv[3]);
  host::Journal journal(std::filesystem::path(argv[3]) / "journal.lcmlog");
  board::OwnCore core(*runtime);
  board::MissionTurn turn(core, ports, journal, clock);
  turn.record_mission(mission.mission, {.policy = search.policy.bytes, .tables = search.tables.bytes, .build = "my_vehicle"});
  program::stop_on_signals();
  std::cout << "waiting for navigation, SNR and START on\n" << ports.description() << std::flush;
  const board::LoopResult result =
      board::fly(turn, ports, clock, {.period = mission.step_period, .turns = mission.turns}, program::stop_requested);
  journal.conclude(board::closing_record_of(result));
  return journal.close() == Status::kOk ? 0 : 3;
} catch (const std::exception& e) {
  std::cerr << "my_vehicle: " << e.what() << "\n";
  return 2;
}
