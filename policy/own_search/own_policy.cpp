#include "policy/own_search/own_policy.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/key_pair.hpp"
#include "policy/description/search_description.hpp"
#include "policy/description/state.hpp"
#include "policy/description/trained_task.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/tables/signed_tables.hpp"
#include "sim/search/scenario/placement.hpp"

namespace earshot::own_search {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// The search of policy/ppo/runs/shipped.toml, in an area of another size.
search::SearchSettings settings_of(const OwnSearch& search, const policy::FrozenPolicy& shipped) {
  search::SearchSettings settings;
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{search.area_north_m}, Meters{search.area_east_m}}};
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::start_region_of(settings, search::StartPlacement::kInsideBorder);
  settings.step_length = shipped.step_length;
  settings.detection_threshold = shipped.detection_threshold;
  settings.listening = shipped.observation.listening;
  return settings;
}

host::SecretKey own_key(const fs::path& file) {
  if (fs::exists(file)) return host::read_signing_key(file);
  return host::make_key_pair(file, host::LonePublicHalf::kStays);
}

/// None where none that ship are of this search.
std::optional<host::TablesFile> shipped_tables_for(const OwnSearch& search) {
  const policy::SearchedSound sound{
      .vehicle_depth = Meters{search.depth_m}, .frequency = Hertz{search.frequency_hz}, .furthest = Meters{furthest_m(search)}};
  std::vector<host::TablesFile> files = host::read_tables_files(std::vector{host::shipped("policy/tables/shipped")});
  const auto is_of_it = [&sound](const host::TablesFile& file) {
    return policy::coverage(*file.tables, sound) == policy::Coverage::kCovered;
  };
  if (std::ranges::none_of(files, is_of_it)) return std::nullopt;
  const host::TablesFile& nearest = host::tables_for(files, sound, "this search");
  return std::move(files[static_cast<std::size_t>(&nearest - files.data())]);
}

}  // namespace

FliesBy flies_by(const OwnSearch& search) {
  if (search.own_tables || !shipped_tables_for(search)) return FliesBy::kTablesToBeMade;
  return is_of_shipped_size(search) ? FliesBy::kWhatShips : FliesBy::kOwnPolicy;
}

void write_own_policy(const fs::path& folder, const OwnSearch& search) {
  const fs::path shipped_file = host::shipped("policy/frozen/shipped.policy");
  const std::unique_ptr<policy::FrozenPolicy> shipped = host::policy_from(host::read_policy_bytes(shipped_file), shipped_file);
  const search::SearchSettings settings = settings_of(search, *shipped);
  description::SearchDescription described =
      description::describe(settings, description::observation_of(description::State::kBelief, 1, settings));
  described.provenance = {{"made_by", "earshot init"}, {"network", "none: the belief's own advice"}};
  for (auto& line : description::task_lines(settings, Meters{search.depth_m})) described.provenance.push_back(std::move(line));
  const host::SecretKey key = own_key(folder / kKeyFile);
  host::write_whole(folder / kPolicyFile, text_of(freeze::sign(*freeze::freeze_advice(described, shipped->draw), key)));
  const std::optional<host::TablesFile> tables = search.own_tables ? std::nullopt : shipped_tables_for(search);
  if (tables) host::write_whole(folder / kTablesFile, text_of(tables::sign(*tables->tables, key)));
}

}  // namespace earshot::own_search
