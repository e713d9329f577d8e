#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/policy/envelope/envelope.hpp"
#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

inline constexpr std::uint32_t kTablesVersion = 1;

inline constexpr SectionTag kGridSection = {'G', 'R', 'I', 'D'};
inline constexpr SectionTag kOceansSection = {'O', 'C', 'N', 'S'};

namespace format {

/// What the sections of a `.tables` file hold, in their order in the file.
enum class TablesContent : std::uint8_t { kGrid, kOceans, kProvenance };

inline constexpr std::array<Section, 3> kTablesSections = {{{kGridSection, 1}, {kOceansSection, 1}, {kProvenanceSection, 1}}};

inline constexpr FileKind kTablesFile{
    .magic = {'E', 'A', 'R', 'S', 'H', 'O', 'T', 'T'}, .version = kTablesVersion, .sections = kTablesSections};

}  // namespace format

/// Size of the largest `.tables` file, bytes.
[[nodiscard]] std::size_t max_tables_size();

/// Reads the bytes of a `.tables` file into `tables` and judges its sizes and numbers. On failure `tables` is unspecified.
/// Layout (little-endian): see README.md of this folder. The bytes end with public key, CRC-32, signature, which the shell checks.
[[nodiscard, gnu::cold]] Status parse(std::span<const std::uint8_t> bytes, OceanTables& tables, PolicyComplaint& complaint);

/// Writes `tables` as the bytes of a `.tables` file, CRC-32 in place, signature bytes zero (whoever has the key signs).
/// @return number of bytes written; kFull if `bytes` is too small; kOutOfRange for tables that parse() would refuse.
[[nodiscard]] Result<std::size_t> serialise(const OceanTables& tables, std::span<const std::uint8_t, kPublicKeySize> public_key,
                                            std::span<std::uint8_t> bytes);

}  // namespace earshot::policy
