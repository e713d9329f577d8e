#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/search/settings.hpp"

namespace earshot::search {

/// What people call where the source is put, in the order of SourcePlacement.
inline constexpr std::array<std::string_view, 2> kPlacements{"fixed", "changing"};
[[nodiscard]] std::string_view name_of(SourcePlacement placement);
/// Nothing for a name that is none of kPlacements.
[[nodiscard]] std::optional<SourcePlacement> placement_named(std::string_view name);

/// Where the vehicle starts.
enum class StartPlacement : std::uint8_t {
  kDomain,        ///< anywhere
  kInsideBorder,  ///< where the border costs nothing
};

/// What people call it, in the order of StartPlacement.
inline constexpr std::array<std::string_view, 2> kStartPlacements{"domain", "inside_border"};
/// Nothing for a name that is none of kStartPlacements.
[[nodiscard]] std::optional<StartPlacement> start_placement_named(std::string_view name);

/// The start region of settings whose domain and border are settled.
[[nodiscard]] Rectangle start_region_of(const SearchSettings& settings, StartPlacement start);

}  // namespace earshot::search
