#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

std::optional<Name> name_in(const Frame& claim) {
  if (claim.size < 8) return std::nullopt;
  Name name = 0;
  for (unsigned i = 0; i < 8; ++i) name |= Name{claim.data[i]} << (8U * i);
  return name;
}

void Directory::accept(std::uint8_t source, const Frame& claim) {
  const std::optional<Name> name = name_in(claim);
  if (!name) return;
  for (Name& other : names_) {
    if (other == *name) other = kNobody;
  }
  if (source < kNullAddress) names_[source] = *name;
}

}  // namespace earshot::n2k
