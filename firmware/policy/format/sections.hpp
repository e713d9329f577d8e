#pragma once

#include <array>
#include <cstdint>

#include "firmware/policy/envelope/envelope.hpp"
#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/format/policy_format.hpp"

// Layout of a policy that reader and writer share; README.md of this folder shows it as a table.
namespace earshot::policy::format {

// How a file states the shape of a network.
inline constexpr std::uint8_t kNoNetwork = 0;
inline constexpr std::uint8_t kTwoTanhLayers = 1;
inline constexpr std::uint8_t kStatedLayers = 2;  ///< their activation and their number, too

/// What the sections hold, in their order in the file.
enum class Content : std::uint8_t { kNetwork, kObservation, kActions, kDraw, kBelief, kProvenance, kGolden };

inline constexpr std::array<Section, 7> kSections = {{{kNetworkSection, 2},
                                                      {kObservationSection, 1},
                                                      {kActionsSection, 1},
                                                      {kDrawSection, 1},
                                                      {kBeliefSection, 2},
                                                      {kProvenanceSection, 1},
                                                      {kGoldenSection, 1}}};

inline constexpr FileKind kPolicyFile{.magic = {'E', 'A', 'R', 'S', 'H', 'O', 'T', 'P'}, .version = kFormatVersion, .sections = kSections};

}  // namespace earshot::policy::format
