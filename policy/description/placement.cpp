#include "policy/description/placement.hpp"

#include <algorithm>
#include <cstddef>

#include "sim/search/scenario/placement.hpp"

namespace earshot::description {

std::optional<search::SourcePlacement> placement_in(std::string_view provenance) {
  constexpr std::string_view kName = "source = ";
  while (!provenance.empty()) {
    const std::string_view line = provenance.substr(0, provenance.find('\n'));
    if (line.starts_with(kName)) return search::placement_named(line.substr(kName.size()));
    provenance.remove_prefix(std::min(provenance.size(), line.size() + 1));
  }
  return std::nullopt;
}

}  // namespace earshot::description
