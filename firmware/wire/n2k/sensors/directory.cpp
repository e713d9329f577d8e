#include "firmware/wire/n2k/sensors/directory.hpp"

#include <algorithm>

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
  const auto* before = std::find_if(places_.begin(), places_.end(),
                                    [&](std::uint8_t place) { return place != kNowhere && names_[place - std::size_t{1}] == *name; });
  if (before != places_.end()) forget(static_cast<std::uint8_t>(before - places_.begin()));
  if (source >= kNullAddress) return;
  forget(source);
  if (*name == kNobody) return;
  auto* const free = std::find(names_.begin(), names_.end(), kNobody);
  if (free == names_.end()) {
    ++unknown_;
    return;
  }
  *free = *name;
  places_[source] = static_cast<std::uint8_t>(free - names_.begin() + 1);
}

void Directory::forget(std::uint8_t address) {
  const std::size_t place = places_[address];
  if (place != kNowhere) names_[place - 1] = kNobody;
  places_[address] = kNowhere;
}

}  // namespace earshot::n2k
