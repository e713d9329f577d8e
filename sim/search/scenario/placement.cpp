#include "sim/search/scenario/placement.hpp"

#include <algorithm>
#include <cstddef>

namespace earshot::search {
namespace {

template <class Placement>
std::optional<Placement> named(const std::array<std::string_view, 2>& names, std::string_view name) {
  const auto* const found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Placement>(found - names.begin());
}

}  // namespace

std::string_view name_of(SourcePlacement placement) {
  return kPlacements[static_cast<std::size_t>(placement)];
}

std::optional<SourcePlacement> placement_named(std::string_view name) {
  return named<SourcePlacement>(kPlacements, name);
}

std::optional<StartPlacement> start_placement_named(std::string_view name) {
  return named<StartPlacement>(kStartPlacements, name);
}

Rectangle start_region_of(const SearchSettings& settings, StartPlacement start) {
  return start == StartPlacement::kDomain ? settings.domain : inside_border(settings);
}

}  // namespace earshot::search
