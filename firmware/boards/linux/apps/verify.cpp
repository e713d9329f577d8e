// earshot verify: what a vehicle would say to a mission or a policy.

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"

namespace {

using namespace earshot;

struct Options {
  std::optional<std::filesystem::path> vehicle;
  std::optional<std::filesystem::path> file;
  std::optional<std::uint64_t> new_counter;
  std::optional<std::uint64_t> raised_counter;
};

std::string beginning_of(const std::filesystem::path& path) {
  std::string start(8, '\0');
  host::InputFile file(path, host::kAnySize);
  start.resize(file.read({reinterpret_cast<std::uint8_t*>(start.data()), start.size()}));
  return start;
}

int verify_policy(const std::filesystem::path& path, const host::VehicleFile& vehicle) {
  const host::SignedPolicy policy =
      host::signed_policy_from(host::read_policy_bytes(path), path, vehicle.policy_keys, "trust.policy_keys of " + vehicle.path.string());
  host::require_repeats_golden(*policy.policy, path);
  program::print() << "policy   " << host::printable(path.string()) << "\n         signed by " << host::printable(policy.signer.string())
                   << "\n";
  return program::kDone;
}

int verify_tables(const std::filesystem::path& path, const host::VehicleFile& vehicle) {
  const host::SignedTables tables =
      host::signed_tables_from(host::read_tables_bytes(path), path, vehicle.policy_keys, "trust.policy_keys of " + vehicle.path.string());
  program::print() << "tables   " << host::printable(path.string()) << "\n         signed by " << host::printable(tables.signer.string())
                   << "\n";
  return program::kDone;
}

/// A desk ashore has a copy of the vehicle's configuration, and not its counter.
int verify_mission(const std::filesystem::path& path, const host::VehicleFile& vehicle) {
  std::error_code error;
  const bool has_counter = vehicle.requires_signed_mission && std::filesystem::exists(vehicle.counter_file, error);
  host::MissionVerifier verifier(vehicle, has_counter ? host::Counting::kOnlyRead : host::Counting::kLeftOut);
  const host::MissionFile file = verifier.load_mission(path);
  const host::SignedSearch search = verifier.load_search(file);
  const host::SignedPolicy& policy = search.policy;
  host::require_repeats_golden(*policy.policy, file.policy);
  host::check_fits(*policy.policy, file.policy, file.mission, path);
  std::ostream& out = program::print();
  out << "mission  " << host::printable(path.string()) << "\n";
  if (verifier.manifest()) {
    out << "         signed by " << host::printable(verifier.mission_signer().string()) << "\ncounter  " << verifier.manifest()->counter
        << "\n";
    if (has_counter) out << "         flown last: " << verifier.flown_last().counter << "\n";
  } else {
    out << "         needs no signature: trust.require_signed_mission is false\n";
  }
  out << "policy   " << host::printable(file.policy.string()) << "\n         signed by " << host::printable(policy.signer.string()) << "\n";
  if (!search.tables_file.empty())
    out << "tables   " << host::printable(search.tables_file.string()) << "\n         signed by "
        << host::printable(search.tables.signer.string()) << "\n";
  if (has_counter || !verifier.manifest()) return program::kDone;
  std::cerr << "earshot verify: " << host::printable(vehicle.counter_file.string())
            << ": no such file: whether a later mission has flown was not judged\n";
  return program::kIncomplete;
}

void set_counter(const host::VehicleFile& vehicle, const Options& o) {
  if (o.new_counter && o.raised_counter) throw host::BadInput("--raise-counter: not with --new-counter, which makes the file");
  if (vehicle.counter_file.empty())
    throw host::BadInput(vehicle.path.string() + ": trust.counter_file is missing: there is no name for it");
  if (o.new_counter) host::begin_counter(vehicle.counter_file, *o.new_counter);
  if (o.raised_counter) host::raise_counter(vehicle.counter_file, *o.raised_counter);
  program::print() << host::printable(vehicle.counter_file.string()) << ": missions with a counter above "
                   << (o.new_counter ? *o.new_counter : *o.raised_counter) << " may be flown\n";
}

int run(const Options& o) {
  const std::optional<std::filesystem::path> vehicle_file = host::vehicle_file_of(o.vehicle);
  if (!vehicle_file) throw host::BadInput(std::string("--vehicle: names no file, and there is no ") + host::kVehicleFile);
  const host::VehicleFile vehicle = host::load_vehicle(*vehicle_file);
  const bool sets_counter = o.new_counter || o.raised_counter;
  if (!o.file && !sets_counter) throw host::BadInput("earshot verify: nothing to do: no FILE, no --new-counter and no --raise-counter");
  if (sets_counter) set_counter(vehicle, o);
  if (!o.file) return program::kDone;
  const std::string beginning = beginning_of(*o.file);
  const std::filesystem::path kind = o.file->extension();  // where the beginning is damaged, what the file should be is what is missed
  if (beginning == "EARSHOTP" || (kind == ".policy" && beginning != "EARSHOTT")) return verify_policy(*o.file, vehicle);
  return beginning == "EARSHOTT" || kind == ".tables" ? verify_tables(*o.file, vehicle) : verify_mission(*o.file, vehicle);
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot verify",
      "Checks whether a vehicle would fly a mission, a policy or ocean tables, who signed it, and which counter it bears.\n"
      "Exit status: 0 it would, 1 as far as is known without the vehicle's counter, 2 it would not.");
  line.footer("Example: earshot verify --vehicle vehicle.toml search.toml");
  Options options;
  line.option("FILE", &options.file, "mission file (TOML), policy or ocean tables");
  line.option("--vehicle", &options.vehicle,
              std::string("the vehicle's configuration (TOML); default: ") + host::kVehicleFile + " if there is one");
  line.option("--new-counter", &options.new_counter,
              "make the vehicle's counter file, which must not be there: 0 for a new vehicle; else the counter of the last mission that it "
              "may have flown")
      .from(0, host::kHighestSetCounter);
  line.option("--raise-counter", &options.raised_counter,
              "refuse all missions with a counter up to this from now on, so that one far above what has flown may be flown: a mission "
              "raises the counter by 4294967296 at most")
      .from(1, host::kHighestSetCounter);
  return program::run(line, argc, argv, [&] { return run(options); });
}
