#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/random.hpp"
#include "firmware/policy/ocean_belief/hypotheses/drift.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// One explanation of what is heard, but for the place: everything that a mission does not know of the ocean and the source.
struct Hypothesis {
  std::uint8_t table = 0;     ///< which of the OceanTables
  std::uint8_t level = 3;     ///< index of kLevelOffsets_db
  std::uint8_t spread = 2;    ///< index of kSpreads_db
  std::uint8_t silence = 0;   ///< index of kSilenceShares
  std::uint8_t mobility = 0;  ///< index of kMobilities
  Drift drift = {};
  friend constexpr bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

/// The current of a hypothesis; none where the source swims.
[[nodiscard]] inline Drift current_of(const Hypothesis& hypothesis) {
  return hypothesis.drift.is_current ? hypothesis.drift : Drift{};
}

/// The source is that much louder than the table says: its level and the noise are known no better.
inline constexpr std::array<float, 7> kLevelOffsets_db{-9.0F, -6.0F, -3.0F, 0.0F, 3.0F, 6.0F, 9.0F};
/// Standard deviation of what is measured about that: fluctuation, and what the table says wrongly.
inline constexpr std::array<float, 4> kSpreads_db{1.0F, 2.0F, 4.0F, 7.0F};
/// Share of the measurements that meet a pause in the call.
inline constexpr std::array<float, 4> kSilenceShares{0.0F, 0.25F, 0.5F, 0.75F};

/// Prior probabilities of these levels and shares; those of each kind add up to one.
inline constexpr std::array<float, kLevelOffsets_db.size()> kLevelPriors{0.07F, 0.13F, 0.19F, 0.22F, 0.19F, 0.13F, 0.07F};
inline constexpr std::array<float, kSilenceShares.size()> kSilencePriors{0.85F, 0.07F, 0.05F, 0.03F};

/// How the source may move between two measurements, besides its drift: this way and that.
struct Mobility {
  std::uint8_t cells;    ///< how far at most, in either direction
  std::int16_t penalty;  ///< of each of them, log weight
};
inline constexpr std::array<Mobility, 4> kMobilities{{{0, 0}, {1, 3 * 512}, {1, 512}, {2, 512}}};

/// log2 of the prior probability, in 1/512.
[[nodiscard]] int log_prior(const Hypothesis& hypothesis, const OceanTables& tables);

/// Of that the part that is the ocean's.
[[nodiscard]] int log_prior_of_ocean(const Hypothesis& hypothesis, const OceanTables& tables);

/// Which hypotheses are drawn: a source that may move takes four times as long to weigh as one that rests.
enum class Motion : std::uint8_t { kAtRest, kMoving };

/// Draws from the prior of those.
[[nodiscard]] Hypothesis draw_hypothesis(const OceanTables& tables, Motion motion, Pcg32& random);

/// One like `parent` but for one or two of its parts, and for whether the source moves.
[[nodiscard]] Hypothesis draw_neighbour(const Hypothesis& parent, const OceanTables& tables, Motion motion, Pcg32& random);

}  // namespace earshot::policy
