#include "hil/bench/before_flight.hpp"

#include <algorithm>
#include <set>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/can_socket.hpp"

namespace earshot::hil {
namespace {

constexpr std::string_view kResults = "results.json";
/// How nlohmann's JSON of Results::text() begins.
constexpr host::OutputKind kResultsOutput{"what earshot-bench writes", {"{\n \"cases\":", {}}};

/// "." and ".." are none, and a hidden one is overlooked.
bool can_be_folder(const std::string& name) {
  return !name.starts_with('.') && name != kResults && host::printable(name) == name;
}

}  // namespace

void require_flyable(const std::vector<Case>& cases) {
  if (cases.empty()) throw host::BadInput("there is no case (NAME.toml)");
  std::set<std::string> names;
  for (const Case& c : cases) {
    const std::string name = host::printable(c.name);
    if (!can_be_folder(c.name)) throw host::BadInput(name + ".toml: a case of this name can have no folder of its own; name it otherwise");
    if (!names.insert(c.name).second) throw host::BadInput(name + ": two cases have this name");
    (void)host::load_mission(c.mission);
  }
}

std::filesystem::path results_file(const std::filesystem::path& out) {
  return out / kResults;
}

host::FileDescriptor take_folder(const std::filesystem::path& out) {
  std::filesystem::create_directories(out);
  host::FileDescriptor lock = host::lock_folder(out);
  host::require_writable(results_file(out), kResultsOutput, host::Replace::kOwnKind, "name another folder");
  return lock;
}

std::optional<host::BusLock> take_bus(const std::vector<Case>& cases, const std::string& interface) {
  if (std::ranges::none_of(cases, [](const Case& c) { return c.bus == host::PortKind::kCan; })) return std::nullopt;
  if (!host::CanSocket(interface).is_up()) throw host::BadInput("CAN interface " + interface + ": is down; set it up first");
  static_cast<void>(host::lock_can(interface));  // nobody flies on it; an earshotd of the bench locks it for itself, as at sea all of it
  return host::lock_can(interface + " for the bench");
}

}  // namespace earshot::hil
