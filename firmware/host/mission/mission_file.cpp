#include "firmware/host/mission/mission_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/mission/authority_table.hpp"
#include "firmware/host/mission/hydrophone_table.hpp"
#include "firmware/host/mission/port_table.hpp"
#include "firmware/host/mission/rule_words.hpp"
#include "firmware/host/mission/safety_table.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {
namespace {

constexpr double kFarthest_m = 1e6;    // of a local plane
constexpr double kDeepest_m = 11'000;  // of any ocean
constexpr double kSlowest_mps = 0.01;  // less is a drift, and no search
constexpr double kShortestStep_m = 1.0;
constexpr double kLongest_s = 1e7;    // four months
constexpr double kShortest_s = 1e-6;  // less would be rounded to nothing

Duration seconds(double s) {
  return {std::llround(s * 1e6)};
}

void read_area(TableReader area, config::Mission& mission) {
  const Range anywhere = Range::between(-kFarthest_m, kFarthest_m);
  Rectangle& r = mission.operating_area;
  r.south_west = {Meters{area.number("south_m", anywhere)}, Meters{area.number("west_m", anywhere)}};
  r.north_east = {Meters{area.number("north_m", anywhere)}, Meters{area.number("east_m", anywhere)}};
  mission.edge_margin = Meters{area.number("edge_margin_m", Range::between(0.0, kFarthest_m))};
}

void read_search(TableReader search, config::Mission& mission) {
  mission.search_depth = Meters{search.number("depth_m", Range::above_up_to(0.0, kDeepest_m))};
  mission.search_speed = MetersPerSecond{search.number("speed_mps", Range::between(kSlowest_mps, 20.0))};
  mission.step_length = Meters{search.number("step_length_m", Range::between(kShortestStep_m, kFarthest_m))};
  mission.max_steps = static_cast<std::uint32_t>(search.integer("max_steps", 1, 1'000'000));
  mission.ends_when_found = search.choice_or("on_found", 0, {"go_on", "end"}) == 1;
  mission.detection_threshold = Decibels{search.number("detection_threshold_db", Range::between(-200.0, 200.0))};
  mission.source_frequency = Hertz{search.number_or("source_frequency_hz", 20.0, Range::between(1.0, 10'000.0))};
  mission.listening = read_listening(search);
}

void read_limits(TableReader limits, config::Mission& mission) {
  mission.max_depth = Meters{limits.number("max_depth_m", Range::above_up_to(0.0, kDeepest_m))};
  mission.max_time = seconds(limits.number("max_time_s", Range::between(kShortest_s, kLongest_s)));
  mission.navigation_timeout = seconds(limits.number("navigation_timeout_s", Range::between(kShortest_s, 3600.0)));
  mission.snr_timeout = seconds(limits.number("snr_timeout_s", Range::between(kShortest_s, 3600.0)));
}

void read_origin(TableReader origin, MissionFile& file) {
  const n2k::Geographic place{.latitude_deg = origin.number("latitude_deg", Range::between(-80.0, 80.0)),
                              .longitude_deg = origin.number("longitude_deg", Range::between(-180.0, 180.0))};
  const Result<n2k::LocalPlane> plane = n2k::LocalPlane::about(place);
  if (plane.ok()) {
    file.plane = plane.value();
  } else {
    origin.problem("latitude_deg", "no local plane about this origin");
  }
}

void read_hearing(TableReader hydrophone, const TableReader& search, MissionFile& file) {
  file.hearing = read_hydrophone(hydrophone, search, file.mission);
  const auto hydrophones = std::ranges::count_if(file.ports, [](const PortSettings& port) { return port.roles.has(Role::kHydrophone); });
  if (hydrophones != 1)
    hydrophone.problem("preset",
                       "a mission that listens needs one [[port]] with the role \"hydrophone\", and not " + std::to_string(hydrophones));
}

/// How values that are right by themselves must fit each other.
void check_together(TableReader area, TableReader limits, const TableReader& search, const config::Mission& mission) {
  const Rectangle& r = mission.operating_area;
  const bool is_area = r.north_east.north > r.south_west.north && r.north_east.east > r.south_west.east;
  if (!(r.north_east.north > r.south_west.north)) area.problem("north_m", "must be greater than south_m");
  if (!(r.north_east.east > r.south_west.east)) area.problem("east_m", "must be greater than west_m");
  const bool is_deep_enough = mission.search_depth <= mission.max_depth;
  if (!is_deep_enough)
    limits.problem("max_depth_m",
                   "must be at least search.depth_m (" + search.place_of("depth_m") + " = " + shortly(mission.search_depth.value) + ")");
  if (is_area && is_deep_enough && config::check(mission) != Status::kOk) {
    area.problem("edge_margin_m", "must leave room for two steps of search.step_length_m each way");
  }
}

/// A vehicle that listens itself must not give up its search because of one lost block.
void check_patience(TableReader limits, const MissionFile& file) {
  if (!file.hearing) return;
  const Duration silence = longest_silence_of(*file.hearing) + file.step_period;
  const auto least_s = static_cast<std::int64_t>(std::ceil(silence.to_seconds()));
  if (file.mission.snr_timeout >= Duration::seconds(least_s)) return;
  limits.problem("snr_timeout_s",
                 "must be at least " + std::to_string(least_s) +
                     " where the hydrophone is listened to: for nearly so long no SNR comes after one lost block of sound");
}

void require_named(const std::filesystem::path& path, const std::string& named_at, const char* option) {
  std::error_code error;
  if (named_at.empty() || std::filesystem::exists(path, error)) return;
  throw BadInput(named_at + ": " + printable(std::filesystem::absolute(path).lexically_normal().string()) +
                 ": no such file; relative paths are relative to the mission's folder, " + option + " names another");
}

void read_tables(TableReader policy, const TomlFile& toml, MissionFile& file) {
  constexpr const char* kKey = "tables";
  if (!policy.has(kKey)) return;
  file.tables = toml.resolve(policy.text(kKey));
  file.tables_named_at = policy.place_of(kKey);
}

/// A vehicle that has keys of its own has no use for the mission's.
void read_public_key(TableReader policy, const TomlFile& toml, const VehicleTrust* vehicle, MissionFile& file) {
  constexpr const char* kKey = "public_key_file";
  if (vehicle != nullptr) {
    (void)policy.text_or(kKey, "");
    return;
  }
  file.public_key = toml.resolve(policy.text(kKey));
  file.public_key_named_at = policy.place_of(kKey);
}

/// @param text     that `toml` was read from
/// @param vehicle  null: none judges it but itself
MissionFile read_mission(const TomlFile& toml, const std::string& text, const VehicleTrust* vehicle) {
  TableReader root = toml.root();
  MissionFile file;
  file.step_period = seconds(root.number_or("step_period_s", 1.0, Range::between(0.1, 1.0)));
  file.turns = static_cast<Turns>(root.choice_or("turns", static_cast<std::size_t>(Turns::kPeriodic), {"periodic", "on_arrival"}));
  const TableReader area = root.table("area");
  const TableReader limits = root.table("limits");
  read_area(area, file.mission);
  const TableReader search = root.table("search");
  read_search(search, file.mission);
  read_limits(limits, file.mission);
  SafetyTables safety = safety_tables(root);
  file.mission.safety = read_safety(safety);
  file.ports = read_ports(root, file.mission.navigation_timeout);
  read_authority(root, toml, sha256_of(std::string_view(text)), vehicle, file);
  if (const std::optional<TableReader> hydrophone = root.optional_table("hydrophone")) read_hearing(*hydrophone, search, file);
  read_origin(root.table("origin"), file);
  TableReader policy = root.table("policy");
  file.policy = toml.resolve(policy.text("file"));
  file.policy_named_at = policy.place_of("file");
  read_tables(policy, toml, file);
  read_public_key(policy, toml, vehicle, file);
  file.mission.action_seed = static_cast<std::uint64_t>(policy.integer_or("action_seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  toml.finish();
  check_together(area, limits, search, file.mission);
  check_patience(limits, file);
  toml.finish();
  check_safety(safety, root, search, file.mission);
  toml.finish();
  return file;
}

}  // namespace

void require_named_files(const MissionFile& file) {
  require_named(file.policy, file.policy_named_at, "--policy");
  require_named(file.tables, file.tables_named_at, "--tables");
  require_named(file.public_key, file.public_key_named_at, "--public-key");
}

MissionFile load_mission(const std::filesystem::path& path) {
  const std::string text = read_text(path, kTomlFile);
  return load_mission(TomlFile{path, text}, text);
}

MissionFile load_mission(const TomlFile& file, const std::string& text) {
  return read_mission(file, text, nullptr);
}

MissionFile load_mission(const std::filesystem::path& path, const std::string& text, const VehicleTrust& vehicle) {
  return read_mission(TomlFile{path, text}, text, &vehicle);
}

}  // namespace earshot::host
