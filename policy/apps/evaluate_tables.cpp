#include "policy/apps/evaluate_tables.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "firmware/host/file/shipped.hpp"
#include "firmware/host/trust/keys.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/envelope/envelope.hpp"

namespace earshot::evaluate {
namespace {

bool are_covered(const policy::SearchedSound& sound, std::span<const host::TablesFile> files) {
  return std::ranges::any_of(
      files, [&sound](const host::TablesFile& file) { return policy::coverage(*file.tables, sound) == policy::Coverage::kCovered; });
}

std::string uncovered(const WorldFile& world, const policy::SearchedSound& sound) {
  std::ostringstream text;
  text << world.name << ": no tables that ship are of " << sound.frequency.value << " Hz and " << sound.vehicle_depth.value
       << " m: only the environment's own ocean is thought possible (--tables names others)";
  return text.str();
}

/// The key with whose secret half a file is signed; nothing: its signature does not hold.
std::optional<host::PublicKey> signer_of(const host::TablesFile& file) {
  const host::PublicKey key = policy::format::carried_key(file.bytes);
  if (!host::is_signed_at_end(file.bytes, key)) return std::nullopt;
  return key;
}

}  // namespace

TablesGiven read_tables(const std::vector<std::string>& named) {
  std::vector<std::filesystem::path> files(named.begin(), named.end());
  if (files.empty()) files.push_back(host::shipped("policy/tables/shipped"));
  return {.files = host::read_tables_files(files), .are_named = !named.empty()};
}

std::vector<const host::TablesFile*> tables_of_worlds(const TablesGiven& given, std::span<const WorldFile> worlds,
                                                      const search::SearchSettings& settings, std::vector<std::string>& warnings) {
  std::vector<const host::TablesFile*> chosen;
  std::set<const host::TablesFile*> seen;
  for (const WorldFile& world : worlds) {
    const policy::SearchedSound sound = sound_of(world, settings);
    if (!given.are_named && !are_covered(sound, given.files)) {
      warnings.push_back(uncovered(world, sound));
      chosen.push_back(nullptr);
      continue;
    }
    const host::TablesFile& file = host::tables_for(given.files, sound, "--tables: world " + world.name);
    if (seen.insert(&file).second && !signer_of(file))
      warnings.push_back(file.path.string() + ": is not signed with the key that it names: a vehicle refuses it");
    chosen.push_back(&file);
  }
  return chosen;
}

std::optional<FlownTables> described(const host::TablesFile* file) {
  if (file == nullptr) return std::nullopt;
  const std::optional<host::PublicKey> key = signer_of(*file);
  return FlownTables{.file = file->path.string(),
                     .sha256 = host::to_hex(host::sha256_of(file->bytes)),
                     .count = file->tables->tables.size(),
                     .signed_by = key ? host::to_hex(*key) : ""};
}

}  // namespace earshot::evaluate
