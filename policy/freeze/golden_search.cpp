#include "policy/freeze/golden_search.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "firmware/core/random.hpp"
#include "firmware/messages/snr_measurement.hpp"

namespace earshot::freeze {
namespace {

constexpr double kNoise_db = 3.0;

Decibels modelled_snr(const policy::OceanTables& tables, Meters range) {
  const auto last = static_cast<double>(tables.range_count - 1);
  return Decibels{double{tables.tables[0].snr_db(static_cast<std::size_t>(std::min(range / tables.range_step, last)))}};
}

/// A place at so many parts of the area's sides.
NorthEast at(const policy::FrozenPolicy& policy, double north, double east) {
  return {north * policy.area_size.north, east * policy.area_size.east};
}

NorthEast held_in_area(const policy::FrozenPolicy& policy, NorthEast place) {
  return {.north = std::clamp(place.north, Meters{0.0}, policy.area_size.north),
          .east = std::clamp(place.east, Meters{0.0}, policy.area_size.east)};
}

/// One golden search: where it begins, where the source is, and who chooses the way.
struct Plan {
  NorthEast start;
  NorthEast source;
  bool policy_decides;
  bool sometimes_too_faint;
};

/// The action that the policy would take after the steps that `memory` knows of.
std::size_t decided(const policy::FrozenPolicy& policy, const policy::SearchMemory& memory, Pcg32& random) {
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
  const std::span<float> seen = std::span(observation).first(policy.observation.spec.size());
  const std::span<float> scores = std::span(logits).first(policy.actions.size());
  policy::observe(memory, policy.observation, seen);
  policy::find_logits(policy, seen, scores);
  return policy::draw_action(policy.draw, scores, random);
}

/// Places and sounds of one search.
void plan_search(const policy::FrozenPolicy& policy, const policy::OceanTables& tables, const Plan& plan, Pcg32& random,
                 policy::GoldenTrajectory& trajectory) {
  const auto memory = std::make_unique<policy::SearchMemory>();
  NorthEast place = held_in_area(policy, plan.start);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double noise = kNoise_db * (2.0 * static_cast<double>(random.uniform_float()) - 1.0);
    const Decibels snr{modelled_snr(tables, range_between(place, plan.source)).value + noise};
    const policy::GoldenReception reception{.snr = std::clamp(snr, -messages::kMostSnr, messages::kMostSnr),
                                            .too_faint = plan.sometimes_too_faint && i % 2 == 0};
    trajectory[i].place = place;
    trajectory[i].reception = reception;
    i == 0 ? memory->start(policy.observation, tables, place, reception.heard())
           : memory->remember(policy.observation, tables, place, reception.heard());
    const std::size_t round = i * (policy.actions.size() / 2 + 1) % policy.actions.size();
    const std::size_t action = plan.policy_decides ? decided(policy, *memory, random) : round;
    place = held_in_area(policy, place + policy.step_length * policy.actions[action]);
  }
}

}  // namespace

void fly_golden_searches(policy::FrozenPolicy& policy) {
  static_assert(config::kGoldenTrajectories == 2);
  const auto tables = std::make_unique<policy::OceanTables>();
  policy::make_golden_tables(policy.area_size, *tables);
  Pcg32 random(1);
  plan_search(policy, *tables, {at(policy, 0.4, 0.35), at(policy, 0.6, 0.7), true, false}, random, policy.golden[0]);
  plan_search(policy, *tables, {at(policy, 0.01, 0.02), at(policy, 0.8, 0.3), false, true}, random, policy.golden[1]);
  const auto memory = std::make_unique<policy::SearchMemory>();
  policy::record_golden(policy, *memory, *tables);
}

}  // namespace earshot::freeze
