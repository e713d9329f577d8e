#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/core/status.hpp"

namespace earshot::policy {

/// What is wrong with a policy, or with ocean tables, for the message a person reads; the Status says what to do.
enum class PolicyFault : std::uint8_t {
  kNone,
  kTooShort,               ///< shorter than its header or its own length field says
  kTooLong,                ///< longer than its own length field says
  kBadMagic,               ///< not a .policy file
  kUnknownVersion,         ///< of another format than kFormatVersion, older or later
  kBadChecksum,            ///< CRC-32 does not match
  kUnknownSection,         ///< a section of a kind this build does not know
  kUnknownSectionVersion,  ///< a section of another version than this build's
  kMissingSection,         ///< a section is not there, or not in its place
  kSectionTwice,           ///< a section stands there again
  kBadSectionLength,       ///< a section is longer or shorter than what it says it holds
  kBadShape,               ///< a size is zero, over its capacity, or sizes contradict each other
  kTooLarge,               ///< a network larger than this build holds
  kUnknownActivation,
  kUnknownFeature,
  kUnknownDraw,
  kUnknownListening,  ///< no known way to sum up several measurements
  kNotFinite,         ///< a number is NaN, infinite, or no such thing (a direction not of length one)
  kOutOfRange,        ///< a number of the search or the belief is not within its limits
  kUnbounded,         ///< scales or weights so large that an observation could make an element or a logit that is no number
  kNoAdvice,          ///< no network, and an observation that does not show every action's preference
  kGoldenMismatch,    ///< this build, flying the golden trajectories again, does not give what is written there
};

/// Four letters that name a section of a file.
using SectionTag = std::array<char, 4>;

inline constexpr SectionTag kNetworkSection = {'N', 'E', 'T', 'W'};
inline constexpr SectionTag kObservationSection = {'O', 'B', 'S', 'V'};
inline constexpr SectionTag kActionsSection = {'A', 'C', 'T', 'N'};
inline constexpr SectionTag kDrawSection = {'D', 'R', 'A', 'W'};
inline constexpr SectionTag kBeliefSection = {'B', 'E', 'L', 'F'};
inline constexpr SectionTag kProvenanceSection = {'P', 'R', 'O', 'V'};
inline constexpr SectionTag kGoldenSection = {'G', 'O', 'L', 'D'};

/// What is wrong, and where.
struct PolicyComplaint {
  PolicyFault fault = PolicyFault::kNone;
  SectionTag section{};       ///< that is wrong; zeros: what stands about the sections is
  std::uint32_t version = 0;  ///< that the file, or the section, says it has; of the two faults of versions only
  std::uint64_t size = 0;     ///< bytes that its network takes; of kTooLarge only

  [[nodiscard]] constexpr bool is_none() const { return fault == PolicyFault::kNone; }
};

[[nodiscard]] Status status_of(PolicyFault fault);

/// A sentence about "it", the policy or one of its sections: "is cut short".
[[nodiscard]] std::string_view to_string(PolicyFault fault);

}  // namespace earshot::policy
