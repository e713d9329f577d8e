#include "policy/description/placement.hpp"

#include <algorithm>
#include <cstddef>

namespace earshot::description {

std::string_view name_of(search::SourcePlacement placement) {
  return kPlacements[static_cast<std::size_t>(placement)];
}

std::optional<search::SourcePlacement> placement_named(std::string_view name) {
  const auto* const found = std::ranges::find(kPlacements, name);
  if (found == kPlacements.end()) return std::nullopt;
  return static_cast<search::SourcePlacement>(found - kPlacements.begin());
}

std::optional<search::SourcePlacement> placement_in(std::string_view provenance) {
  constexpr std::string_view kName = "source = ";
  while (!provenance.empty()) {
    const std::string_view line = provenance.substr(0, provenance.find('\n'));
    if (line.starts_with(kName)) return placement_named(line.substr(kName.size()));
    provenance.remove_prefix(std::min(provenance.size(), line.size() + 1));
  }
  return std::nullopt;
}

}  // namespace earshot::description
