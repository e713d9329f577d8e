#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::host {

/// Ocean tables, the bytes of their file, and who signed it.
struct SignedTables {
  std::unique_ptr<policy::OceanTables> tables;
  std::vector<std::uint8_t> bytes;
  std::filesystem::path signer;  ///< file of the trusted key
};

/// Reads a `.tables` file, checks that the holder of the trusted key signed it (Ed25519), its CRC-32, its sizes and numbers.
/// @param public_key  file of the trusted key: 32 bytes in hexadecimal
/// @throws host::BadInput naming the file and what is wrong with it.
[[nodiscard]] SignedTables load_tables(const std::filesystem::path& path, const std::filesystem::path& public_key);

/// load_tables() of bytes that have been read from `path`.
[[nodiscard]] SignedTables signed_tables_from(std::vector<std::uint8_t> bytes, const std::filesystem::path& path,
                                              const TrustedKey& trusted);
/// The same where several are trusted. @param trusted_by  what says so: "policy_keys of vehicle.toml"
[[nodiscard]] SignedTables signed_tables_from(std::vector<std::uint8_t> bytes, const std::filesystem::path& path,
                                              const std::vector<TrustedKey>& trusted, const std::string& trusted_by);

/// @throws host::BadInput, in one line that names the tables, what they are of and what was asked, unless they cover it
void require_coverage(const policy::OceanTables& tables, const std::filesystem::path& path, const policy::SearchedSound& sound);

/// The tables by which a policy searches in a mission. Nobody has looked at their signature. A policy that holds no belief needs none: no
/// path then, no bytes, and no ocean.
/// @param named         a file, or a folder of which one must cover the mission; empty: the folder of those that ship
/// @param mission_path  for the message
/// @throws BadInput as tables_for()
[[nodiscard]] TablesFile tables_of(const std::filesystem::path& named, const policy::FrozenPolicy& policy, const config::Mission& mission,
                                   const std::filesystem::path& mission_path);

}  // namespace earshot::host
