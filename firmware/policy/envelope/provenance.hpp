#pragma once

#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/envelope/policy_fault.hpp"

namespace earshot::policy {

/// Where a file comes from, for people: UTF-8 "key = value" lines. Nothing where this build keeps none of it.
using Provenance = FixedVector<char, config::kKeptProvenance>;

namespace format {

/// The section of all our files that holds it, to the section's end.
inline PolicyFault read_provenance(ByteReader& reader, Provenance& provenance) {
  if (reader.remaining() > config::kMaxProvenance) return PolicyFault::kBadShape;
  provenance.clear();
  while (reader.remaining() > 0) static_cast<void>(provenance.push_back(static_cast<char>(reader.u8())));  // kFull: passed over
  return PolicyFault::kNone;
}

inline void write_provenance(ByteWriter& writer, const Provenance& provenance) {
  for (const char character : provenance) writer.u8(static_cast<std::uint8_t>(character));
}

}  // namespace format
}  // namespace earshot::policy
