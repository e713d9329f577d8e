#include "firmware/host/trust/vehicle_file.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace earshot::host {
namespace {

constexpr const char* kPolicyKeys = "policy_keys";
constexpr const char* kMissionKeys = "mission_keys";
constexpr const char* kRequire = "require_signed_mission";
constexpr const char* kCounter = "counter_file";
constexpr const char* kCommandKey = "command_key_file";

std::vector<TrustedKey> read_keys(TableReader& trust, const char* name, const TomlFile& toml) {
  std::vector<TrustedKey> keys;
  for (const std::string& file : trust.texts(name)) {
    try {
      keys.push_back(load_public_key(toml.resolve(file)));
    } catch (const BadInput& e) {
      trust.problem(name, e.what());
      continue;
    }
    const auto same = [&](const TrustedKey& key) { return key.key == keys.back().key; };
    if (std::ranges::count_if(keys, same) > 1) trust.problem(name, "\"" + file + "\" is a key that stands there already");
  }
  if (keys.empty() && !trust.is_noted(name)) trust.problem(name, "must name at least one file of a public key");
  return keys;
}

bool is_vehicle_id(std::string_view text) {
  constexpr std::size_t kLongest = 32;
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  };
  return text.size() <= kLongest && std::ranges::all_of(text, fits);
}

}  // namespace

VehicleFile load_vehicle(const std::filesystem::path& path) {
  const TomlFile toml{path};
  TableReader root = toml.root();
  TableReader trust = root.table("trust");
  VehicleFile vehicle;
  vehicle.path = path;
  vehicle.policy_keys = read_keys(trust, kPolicyKeys, toml);
  vehicle.requires_signed_mission = trust.boolean_or(kRequire, true);
  // What is not required may be there: the key that turns it off is the only one to change.
  if (vehicle.requires_signed_mission || trust.has(kMissionKeys)) vehicle.mission_keys = read_keys(trust, kMissionKeys, toml);
  if (vehicle.requires_signed_mission || trust.has(kCounter)) vehicle.counter_file = toml.resolve(trust.text(kCounter));
  if (trust.has(kCommandKey)) vehicle.command_key_file = toml.resolve(trust.text(kCommandKey));
  vehicle.vehicle_id = read_vehicle_id(trust);
  vehicle.accepts_old_marks = trust.boolean_or("accept_old_marks", false);
  toml.finish();
  return vehicle;
}

std::string read_vehicle_id(TableReader& table) {
  constexpr const char* kKey = "vehicle_id";
  std::string named = table.text_or(kKey, "");
  if (named.empty() || is_vehicle_id(named)) return named;
  table.problem(kKey, "must be 1 to 32 letters, digits, '-', '_' or '.'");
  return {};
}

std::vector<std::filesystem::path> files_of(const VehicleFile& vehicle) {
  std::vector<std::filesystem::path> files{vehicle.path};
  for (const std::vector<TrustedKey>* const keys : {&vehicle.policy_keys, &vehicle.mission_keys}) {
    for (const TrustedKey& key : *keys) files.push_back(key.file);
  }
  if (!vehicle.counter_file.empty()) files.push_back(vehicle.counter_file);
  if (vehicle.command_key_file) files.push_back(*vehicle.command_key_file);
  return files;
}

std::optional<std::filesystem::path> vehicle_file_of(const std::optional<std::filesystem::path>& named,
                                                     const std::filesystem::path& usual) {
  if (named) return named;
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::symlink_status(usual, error).type();
  return type == std::filesystem::file_type::not_found ? std::nullopt : std::optional(usual);
}

}  // namespace earshot::host
