#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/check/policy_fault.hpp"
#include "firmware/policy/format/policy_format.hpp"

// Layout that reader and writer share; README.md of this folder shows it as a table.
namespace earshot::policy::format {

inline constexpr std::array<std::uint8_t, 8> kMagic = {'E', 'A', 'R', 'S', 'H', 'O', 'T', 'P'};
inline constexpr std::size_t kLengthAt = 12;
inline constexpr std::size_t kHeaderSize = 16;         // magic, version, length
inline constexpr std::size_t kSectionHeaderSize = 10;  // tag, version, length
inline constexpr std::size_t kChecksumSize = 4;
inline constexpr std::size_t kTrailerSize = kPublicKeySize + kChecksumSize + kSignatureSize;
inline constexpr std::uint8_t kTanh = 1;

enum class Content : std::uint8_t { kNetwork, kObservation, kActions, kDraw, kBelief, kProvenance, kGolden };

struct Section {
  Content content;
  SectionTag tag;
  std::uint16_t version;
};
/// All of them, in their order in the file.
inline constexpr std::array<Section, 7> kSections = {{{Content::kNetwork, kNetworkSection, 1},
                                                      {Content::kObservation, kObservationSection, 1},
                                                      {Content::kActions, kActionsSection, 1},
                                                      {Content::kDraw, kDrawSection, 1},
                                                      {Content::kBelief, kBeliefSection, 1},
                                                      {Content::kProvenance, kProvenanceSection, 1},
                                                      {Content::kGolden, kGoldenSection, 1}}};

}  // namespace earshot::policy::format
