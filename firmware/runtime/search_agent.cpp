#include "firmware/runtime/search_agent.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/tables_format.hpp"
#include "firmware/runtime/bytes_of_state.hpp"
#include "firmware/runtime/known_steps.hpp"

namespace earshot::runtime {
namespace {

/// False for a NaN.
bool are_within(std::span<const float> values, double most) {
  return std::all_of(values.begin(), values.end(), [most](float value) { return double{value} >= -most && double{value} <= most; });
}

/// Without the places of weights that the network does not have: nobody reads them, and a large network has room for many.
std::uint32_t checksum_of_read(const policy::FrozenPolicy& policy) {
  static_assert(std::is_trivially_copyable_v<policy::FrozenPolicy>);
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(&policy), sizeof policy);
  constexpr std::size_t kRoom = sizeof policy.network.numbers;
  const auto begin = static_cast<std::size_t>(reinterpret_cast<const std::uint8_t*>(policy.network.numbers.data()) - bytes.data());
  const auto used = static_cast<std::size_t>(std::min<std::uint64_t>(policy::bytes_of_numbers(policy.network), kRoom));
  return crc32(bytes.subspan(begin + kRoom), crc32(bytes.first(begin + used)));
}

}  // namespace

Status SearchAgent::judge(const config::Mission& mission, const policy::FrozenPolicy& policy) {
  if (policy::mismatch(policy, mission) != policy::Mismatch::kNone) return Status::kOutOfRange;
  return repeats_known_steps() && policy::repeats_golden(policy, memory_, tables_) ? Status::kOk : Status::kCorrupt;
}

void SearchAgent::keep_checksums() {
  policy_checksum_ = checksum_of_read(policy_);
  tables_checksum_ = checksum_of(tables_);
  memory_checksum_ = checksum_of(memory_);
}

Status SearchAgent::load(const config::Mission& mission, const policy::FrozenPolicy& policy, const policy::OceanTables& tables) {
  if (const policy::PolicyComplaint complaint = policy::check(policy); !complaint.is_none()) return policy::status_of(complaint.fault);
  const bool needs_tables = policy::needs_belief(policy.observation.spec);
  if (needs_tables && !policy::are_usable(tables, policy::searched_sound(mission))) return Status::kOutOfRange;
  if (const Status status = judge(mission, policy); status != Status::kOk) return status;
  policy_ = policy;
  tables_.tables.clear();
  if (needs_tables) tables_ = tables;
  keep_checksums();
  return Status::kOk;
}

Status SearchAgent::load(const config::Mission& mission, std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables) {
  policy::PolicyComplaint complaint;
  if (const Status status = policy::parse(policy, policy_, complaint); status != Status::kOk) return status;
  if (const Status status = judge(mission, policy_); status != Status::kOk) return status;
  tables_.tables.clear();
  if (has_belief()) {
    if (const Status status = policy::parse(tables, tables_, complaint); status != Status::kOk) return status;
    if (!policy::are_usable(tables_, policy::searched_sound(mission))) return Status::kOutOfRange;
  }
  keep_checksums();
  return Status::kOk;
}

bool SearchAgent::is_intact() const {
  return checksum_of_read(policy_) == policy_checksum_ && checksum_of(tables_) == tables_checksum_ &&
         checksum_of(memory_) == memory_checksum_;
}

void SearchAgent::start(const config::Mission& mission, NorthEast position, const policy::Reception& reception) {
  memory_.start(policy_.observation, tables_, position - mission.operating_area.south_west, reception);
  memory_checksum_ = checksum_of(memory_);
}

void SearchAgent::remember(const config::Mission& mission, NorthEast position, const policy::Reception& reception) {
  memory_.remember(policy_.observation, tables_, position - mission.operating_area.south_west, reception);
  memory_checksum_ = checksum_of(memory_);
}

bool SearchAgent::refine() {
  const bool is_refining = memory_.refine(policy_.observation, tables_);
  memory_checksum_ = checksum_of(memory_);
  return is_refining;
}

bool SearchAgent::observe(const config::Mission& mission, messages::Decision& decision) const {
  const std::span<float> observation = std::span(decision.observation).first(policy_.observation.spec.size());
  const std::span<float> logits = std::span(decision.logits).first(policy_.actions.size());
  policy::observe(memory_, policy_.observation, observation);
  policy::find_logits(policy_, observation, logits);
  if (!are_within(observation, policy::kMostElement) || !are_within(logits, policy::kMostLogit)) return false;
  decision.observation_size = static_cast<std::uint8_t>(observation.size());
  decision.action_count = static_cast<std::uint8_t>(logits.size());
  if (!has_belief()) return true;
  const NorthEast corner = mission.operating_area.south_west;
  messages::BeliefSummary& belief = decision.belief.emplace(memory_.belief().summary());
  belief.likeliest = belief.likeliest + corner;
  belief.mean = belief.mean + corner;
  decision.found = memory_.belief().declaration();
  if (decision.found) decision.found->likeliest = decision.found->likeliest + corner;
  return true;
}

std::size_t SearchAgent::choose(const config::Mission& mission, const messages::Decision& decision, NorthEast position, Pcg32& random,
                                guidance::Fallback& fallback) const {
  const std::size_t action = policy::draw_action(policy_.draw, std::span(decision.logits).first(policy_.actions.size()), random);
  const bool calls_for_sweep = has_belief() && memory_.belief().calls_for_sweep();
  const guidance::SweepPlan plan{.area = mission.operating_area, .margin = mission.edge_margin, .step_length = mission.step_length};
  return fallback.choose(calls_for_sweep, action, plan, position, std::span(policy_.actions.begin(), policy_.actions.size()));
}

}  // namespace earshot::runtime
