#include "firmware/boards/linux/apps/coming_up_flight.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <exception>
#include <iostream>
#include <optional>
#include <system_error>
#include <utility>

#include "firmware/boards/linux/apps/end_report.hpp"
#include "firmware/boards/linux/apps/flight.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/event_log/event_log.hpp"
#include "firmware/boards/linux/event_log/line_writer.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/open_ports.hpp"
#include "firmware/boards/linux/outage/coming_up.hpp"
#include "firmware/boards/linux/outage/kept_vehicle.hpp"
#include "firmware/boards/linux/outage/outage_time.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::board {
namespace {

/// With slow disks.
constexpr std::chrono::milliseconds kPatience{100};

/// The vehicle as it was kept; else as its mission's file says, if that is there.
host::MissionFile vehicle(const Options& o, const host::SafetyCopies& copies) {
  if (std::optional<host::MissionFile> kept = vehicle_of(copies.kept())) return *std::move(kept);
  try {
    host::MissionFile file = host::load_mission(o.mission);
    host::override_ports(file, o.ports);
    host::leave_out_hydrophones(file);
    return file;
  } catch (const std::exception& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << "\n";
    return {};
  }
}

/// What most vehicles have, where nothing says what this one has.
host::MissionFile over_default_lcm() {
  host::MissionFile file;
  host::PortSettings& port = file.ports.emplace_back();
  port.name = "vehicle";
  port.address = host::kDefaultLcmUrl;
  port.roles = {host::Role::kNavigation, host::Role::kOperator, host::Role::kAutopilot, host::Role::kStatus};
  return file;
}

bool is_for_want_of_descriptors(const std::exception& e) {
  const auto* const error = dynamic_cast<const std::system_error*>(&e);
  return error != nullptr && (error->code().value() == EMFILE || error->code().value() == ENFILE);
}

/// A port is worth more than a further copy of the record, which is read again at the next start.
bool opens(const host::MissionFile& one, const HostClock& host, host::SafetyCopies& copies, PortSet& ports) {
  for (;;) {
    try {
      open_ports(one, host, host::IfMissing::kKeepTrying, WakesFor::kMeasurements, ports);
      return true;
    } catch (const std::exception& e) {
      if (is_for_want_of_descriptors(e) && copies.give_up_one()) continue;
      std::cerr << "earshotd: port " << host::printable(one.ports.front().name)
                << " does not open, and nothing is sent or heard there: " << host::printable(e.what()) << "\n";
      return false;
    }
  }
}

/// One by one: whichever opens will do. @return whether any does
bool open_what_opens(const host::MissionFile& vehicle, const HostClock& host, host::SafetyCopies& copies, PortSet& ports) {
  bool is_any_open = false;
  for (const host::PortSettings& settings : vehicle.ports) {
    host::MissionFile one = vehicle;
    one.ports = {settings};
    is_any_open = opens(one, host, copies, ports) || is_any_open;
  }
  return is_any_open;
}

}  // namespace

int come_up(const Options& o, host::SafetyCopies& copies, const HostClock& host, const std::string& why) {
  std::cerr << "earshotd: " << host::printable_lines(why)
            << "\nearshotd: the mission that was under way cannot go on: the vehicle is ordered to stop and come up until this program is "
               "stopped\n";
  program::ignore_unmeant_signals();
  program::stop_on_signals();
  const host::SafetyRecord record = copies.newest().value();
  const host::MissionFile vehicle = board::vehicle(o, copies);
  // What needs a descriptor but for a moment, or for the service manager, comes before the ports, which may take the last.
  SafetyLog safety(copies, host, record);
  const Outage outage = outage_since(record, host);
  ServiceManager manager = service_manager();
  PortSet ports;
  if (!open_what_opens(vehicle, host, copies, ports)) {
    std::cerr << "earshotd: no port of it opens: LCM's default address is tried\n";
    if (!open_what_opens(over_default_lcm(), host, copies, ports)) {
      std::cerr << "earshotd: no port opens: nobody commands the vehicle; it is tried again when this program is started again\n";
      return program::kLost;  // and the service begins again
    }
  }
  ports.settle(std::chrono::seconds(1));
  HostMissionClock clock(host, o.speed);
  clock.go_on_since(record.mission_time, outage.passed);
  ComingUp core(vehicle.mission, record);
  MissionTurn turn(core, ports, clock);
  turn.write_ahead(kPatience);
  turn.keep_safe(safety);
  turn.report_to(manager);
  std::optional<LineWriter> writer;
  std::optional<EventLog> event_log;
  try {
    if (program::talk() != program::Talk::kQuiet) {
      writer.emplace(STDERR_FILENO);
      event_log.emplace(ports, *writer, o.log_format());
      turn.report_to(*event_log);
    }
  } catch (const std::exception& e) {  // no thread, no descriptor: the vehicle is told, a person is not
    std::cerr << "earshotd: " << host::printable(e.what()) << ": nothing more is reported here\n";
  }
  report_settled_memory();
  const Duration period = vehicle.step_period > Duration{} ? vehicle.step_period : Duration::seconds(1);
  const Pace pace{.period = period, .turns = host::Turns::kPeriodic};
  const LoopResult result = board::fly(turn, ports, clock, pace, program::stop_requested);
  writer.reset();
  if (result.end == LoopEnd::kStopped && !safety.close(std::chrono::seconds(3), core.has_come_up(clock.now()))) std::cerr << kStaysUnderWay;
  return report(result, clock, ports, {});
}

}  // namespace earshot::board
