#pragma once

#include "firmware/policy/tables/tables_format.hpp"
#include "tests/firmware/policy/format/policy_bytes.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"

namespace earshot::policy::in_tables {

// Where things lie in the bytes of made_up_tables(), added up by hand from README.md.
inline constexpr std::size_t kGridAt = 16;  // each section's tag; its version lies 4, its length 6, its content 10 bytes further
inline constexpr std::size_t kFrequencyAt = 26;
inline constexpr std::size_t kReceiverAt = 34;
inline constexpr std::size_t kSourceLeastAt = 42;
inline constexpr std::size_t kSourceMostAt = 50;
inline constexpr std::size_t kSeaLeastAt = 58;
inline constexpr std::size_t kSeaMostAt = 66;
inline constexpr std::size_t kStepAt = 74;
inline constexpr std::size_t kRangeCountAt = 82;
inline constexpr std::size_t kOceansAt = 84;
inline constexpr std::size_t kTableCountAt = 94;
inline constexpr std::size_t kDeepAt = 96;
inline constexpr std::size_t kDeepPriorAt = 101;
inline constexpr std::size_t kDeepSeaAt = 105;
inline constexpr std::size_t kDeepSnrAt = 109;
inline constexpr std::size_t kShelfAt = 112;
inline constexpr std::size_t kShelfPriorAt = 118;
inline constexpr std::size_t kShelfSnrAt = 126;
inline constexpr std::size_t kProvenanceAt = 129;
inline constexpr std::size_t kPublicKeyAt = 145;
inline constexpr std::size_t kChecksumAt = 177;
inline constexpr std::size_t kSizeInAll = 245;

inline Bytes bytes_of(const OceanTables& tables) {
  Bytes bytes(max_tables_size());
  const Result<std::size_t> size = serialise(tables, kPublicKey, bytes);
  EXPECT_TRUE(size.ok());
  bytes.resize(size.ok() ? size.value() : 0);
  return bytes;
}

inline PolicyComplaint complaint_about(std::span<const std::uint8_t> bytes) {
  const auto tables = std::make_unique<OceanTables>();
  PolicyComplaint complaint;
  const Status status = parse(bytes, *tables, complaint);
  EXPECT_EQ(status, status_of(complaint.fault));
  return complaint;
}

/// What parse() says of made_up_tables() after `damage`, length and checksum mended so that only the damage itself can be found.
template <class Damage>
PolicyComplaint complaint_after(Damage damage) {
  Bytes bytes = bytes_of(made_up_tables());
  damage(bytes);
  mend(bytes);
  return complaint_about(bytes);
}

}  // namespace earshot::policy::in_tables
