#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/mission.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/status.hpp"
#include "firmware/guidance/fallback.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::runtime {

/// What observes, believes and chooses in a search. Owns the frozen policy, the ocean tables and the memory of the search, each with a
/// CRC-32: they are too large to be kept twice. Whoever lets it start, decide or refine asks first whether it is_intact().
///
/// Places are in the mission's plane. Every call is given a mission of the same operating area as load().
/// Oracle: SearchAgent.*
class SearchAgent {
 public:
  /// Copies policy and tables. kOutOfRange if the policy was trained for another mission (policy::mismatch) or the tables do not cover it;
  /// what policy::check finds wrong with the policy, by status_of; kCorrupt if this build does not repeat the policy's golden trajectories
  /// or repeats_known_steps(). Whatever is refused, nothing can be decided until something is loaded.
  /// @param mission  one that config::check accepts
  /// @param tables   not looked at when the policy holds no belief
  [[nodiscard]] Status load(const config::Mission& mission, const policy::FrozenPolicy& policy, const policy::OceanTables& tables);
  /// The same from the bytes of their files. @param tables  empty where the policy needs none
  [[nodiscard]] Status load(const config::Mission& mission, std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables);

  /// Whether policy, tables and memory are what the last call left.
  [[nodiscard]] bool is_intact() const;

  /// Forgets everything; the vehicle stands at `position`, where it hears `reception`.
  void start(const config::Mission& mission, NorthEast position, const policy::Reception& reception);
  /// A leg is over: the vehicle stands at `position`; `reception` is what it heard on the leg.
  void remember(const config::Mission& mission, NorthEast position, const policy::Reception& reception);
  /// What the belief makes of all that was heard, a slice at a time. @return whether anything is left
  [[nodiscard]] bool refine();

  /// Writes to `decision` what the policy observes, its logits, and what is believed.
  /// @return false: a number of them is none, or beyond what a policy that was checked can give
  [[nodiscard]] bool observe(const config::Mission& mission, messages::Decision& decision) const;
  /// The policy's action for the logits of `decision`; that of a sweep of the area once what is heard fits nothing that the belief thinks
  /// possible.
  [[nodiscard]] std::size_t choose(const config::Mission& mission, const messages::Decision& decision, NorthEast position, Pcg32& random,
                                   guidance::Fallback& fallback) const;
  /// @param action  one that choose() gave
  [[nodiscard]] UnitNorthEast direction_of(std::size_t action) const { return policy_.actions[action]; }

  [[nodiscard]] bool has_belief() const { return policy::needs_belief(policy_.observation.spec); }
  /// With what was heard last the source was declared found.
  [[nodiscard]] bool has_found() const { return has_belief() && memory_.belief().declaration().has_value(); }
  /// How badly the belief explains what was heard; 0 without a belief.
  [[nodiscard]] float mismatch_bits() const { return has_belief() ? memory_.belief().model_mismatch().bits() : 0.0F; }

 private:
  /// Whether mission and policy fit each other, and this build flies it as it was frozen. Works in memory_ and tables_.
  [[nodiscard]] Status judge(const config::Mission& mission, const policy::FrozenPolicy& policy);
  void keep_checksums();

  policy::FrozenPolicy policy_;
  policy::OceanTables tables_;
  policy::SearchMemory memory_;  ///< begins anew with every search; too large to be assigned by way of the stack
  std::uint32_t policy_checksum_ = 0;
  std::uint32_t tables_checksum_ = 0;
  std::uint32_t memory_checksum_ = 0;  ///< since the last change of the memory
};

}  // namespace earshot::runtime
