#include "firmware/boards/linux/apps/composition.hpp"

#include <iostream>

#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/boards/linux/waiting.hpp"
#include "firmware/core/status.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/serial_line.hpp"

namespace earshot::board {

host::MissionFile load_mission(const Options& o, host::MissionVerifier& verifier) {
  require_as_signed(
      verifier,
      {.policy = o.policy.has_value(), .tables = o.tables.has_value(), .public_key = o.public_key.has_value(), .seed = o.seed.has_value()});
  host::MissionFile file = verifier.load_mission(o.mission);
  if (o.policy) {
    file.policy = *o.policy;
    file.policy_named_at.clear();
  }
  if (o.tables) {
    file.tables = *o.tables;
    file.tables_named_at.clear();
  }
  if (o.public_key) {
    file.public_key = *o.public_key;
    file.public_key_named_at.clear();
  }
  host::require_named_files(file);
  if (o.seed) file.mission.action_seed = *o.seed;
  host::override_ports(file, o.ports);
  return file;
}

host::MissionFile load_mission_for_sea(const Options& o, host::MissionVerifier& verifier) {
  require_ports_as_signed(verifier, o.ports);
  host::MissionFile file = load_mission(o, verifier);
  host::require_ports_for_sea(file, o.mission);
  return file;
}

std::unique_ptr<runtime::Runtime> make_runtime(const host::MissionFile& file, const host::SignedSearch& search,
                                               const std::string& mission_name) {
  host::check_fits(*search.policy.policy, file.policy, file.mission, mission_name);
  auto runtime = std::make_unique<runtime::Runtime>();
  const Status status = runtime->configure(file.mission, *search.policy.policy, *search.tables.tables);
  if (status == Status::kCorrupt) throw host::BadInput(host::to_string({.fault = policy::PolicyFault::kGoldenMismatch}, file.policy));
  if (status != Status::kOk) throw host::BadInput(mission_name + ": cannot be flown with the policy " + file.policy.string());
  return runtime;
}

std::unique_ptr<BoardCore> make_board(const Options& o, const host::MissionFile& file, const host::SignedSearch& search,
                                      std::chrono::seconds patience) {
  if (!o.board) return nullptr;
  return std::make_unique<BoardCore>(host::SerialLine(*o.board), file.mission, search.policy.bytes, search.tables.bytes, patience);
}

void settle(PortSet& ports) {
  if (const std::string down = ports.down(); !down.empty())
    std::cerr << "earshotd: these links are down; tried again once a second:\n" << down;
  ports.settle(std::chrono::seconds(1));
}

std::optional<int> wait_for_clock(const Options& o, const std::string& whose, Clock& clock) {
  const Waited waited =
      wait_for("earshotd", whose, std::chrono::seconds(o.wait_s), [&](std::chrono::milliseconds most) { return clock.has_come(most); });
  if (waited == Waited::kCame) return std::nullopt;
  return waited == Waited::kStopped ? program::kStopped : program::kLost;
}

}  // namespace earshot::board
