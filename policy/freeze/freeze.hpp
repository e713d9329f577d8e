#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/config/listening_window.hpp"
#include "firmware/host/trust/keys.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "policy/description/search_description.hpp"
#include "policy/freeze/trained_actor.hpp"
#include "policy/ppo/checkpoint/checkpoint.hpp"

namespace earshot::freeze {

/// The policy that flies, from what training left: the actor alone, its directions as a table, its provenance as "name = value" lines.
/// Throws host::BadInput when it does not fit firmware's capacities.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> freeze(const ppo::Checkpoint& checkpoint, policy::ActionDraw draw);

/// The policy that flies, from an actor trained elsewhere, its weights bit for bit.
/// Throws host::BadInput when the actor does not fit its description or firmware's capacities.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> freeze(const TrainedActor& actor, const description::SearchDescription& search,
                                                           policy::ActionDraw draw);

/// The policy that flies without a network, by the belief's own advice: the likeliest action is that of least regret
/// (policy::find_logits).
/// @param search  its observation shows every action's preference
/// Throws host::BadInput when it does not, or does not fit firmware's capacities.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> freeze_advice(const description::SearchDescription& search, policy::ActionDraw draw);

/// Lets the policy listen over another window than it was trained with, and says so in one line of its provenance: measured, the shipped
/// policy finds more with it (policy/frozen/README.md). The golden searches stay: they begin with what was heard. Throws host::BadInput
/// when the provenance is full.
void listen_over(policy::FrozenPolicy& policy, config::ListeningWindow window);

/// Throws host::BadInput, beginning with `name`, for a policy that a vehicle would refuse: a size, a number, weights so large that logits
/// could overflow, or provenance that is not lines of text.
void check_flies(const policy::FrozenPolicy& policy, const std::string& name);

/// The bytes of a `.policy` file, signed: Ed25519 over every byte before the signature.
/// Throws host::BadInput for a policy that a vehicle would refuse.
[[nodiscard]] std::vector<std::uint8_t> sign(const policy::FrozenPolicy& policy, const host::SecretKey& key);

}  // namespace earshot::freeze
