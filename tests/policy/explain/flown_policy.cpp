#include "tests/policy/explain/flown_policy.hpp"

#include <algorithm>
#include <string_view>

#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/belief_model.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"
#include "tests/policy/explain/random_network.hpp"

namespace earshot::explain {
namespace {

sonar::SnrCurve falling() {
  std::vector<float> snr_db;
  for (int i = 0; i <= 36; ++i) snr_db.push_back(static_cast<float>(40 - i));
  return {Meters{1'000.0}, std::move(snr_db)};
}

policy::Reception hear(Decibels snr) {
  return snr < kFloor ? policy::Reception{.snr = kFloor, .too_faint = true} : policy::Reception{.snr = snr};
}

std::unique_ptr<policy::FrozenPolicy> with_random_network(const policy::ObservationModel& observation, std::uint64_t seed) {
  const search::SearchSettings settings;
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->observation = observation;
  policy->actions = search::compass_directions(settings.direction_count);
  policy->step_length = settings.step_length;
  policy->area_size = settings.domain.north_east - settings.domain.south_west;
  policy->detection_threshold = settings.detection_threshold;
  Pcg32 random(seed);
  policy->network = *random_network({observation.spec.size(), {16, 16}, policy->actions.size()}, 0.5F, random);
  return policy;
}

}  // namespace

const policy::OceanTables& falling_ocean() {
  static const auto tables = [] {
    auto made = std::make_unique<policy::OceanTables>();
    search::make_known_ocean(search::SearchSettings{}, falling(), *made);
    made->frequency = Hertz{20.0};
    made->receiver_depth = Meters{300.0};
    made->source_depth = {Meters{30.0}, Meters{30.0}};
    made->sea_depth = {Meters{3'000.0}, Meters{3'000.0}};
    policy::OceanTable& ocean = made->tables[0];
    ocean.sea_depth_m = 3'000.0F;
    ocean.name.clear();
    for (const char letter : std::string_view("falling")) (void)ocean.name.push_back(letter);
    return made;
  }();
  return *tables;
}

std::unique_ptr<policy::FrozenPolicy> belief_policy(std::uint64_t seed) {
  policy::ObservationModel observation;
  observation.belief = search::belief_model(search::SearchSettings{});
  observation.spec = policy::belief_state(observation.belief);
  return with_random_network(observation, seed);
}

std::unique_ptr<policy::FrozenPolicy> place_policy(std::uint64_t seed) {
  policy::ObservationModel observation;
  observation.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}});
  return with_random_network(observation, seed);
}

std::unique_ptr<policy::FrozenPolicy> advice_policy() {
  auto policy = belief_policy(1);
  policy->network = {};
  policy->network.observation_size = policy->observation.spec.size();
  policy->network.action_count = policy->actions.size();
  for (policy::ObservationElement& element : policy->observation.spec)
    if (element.feature == policy::Feature::kPreference) element.scale = 10.0F;
  return policy;
}

std::vector<RecordedDecision> flown(const policy::FrozenPolicy& policy, std::size_t decisions, NorthEast south_west,
                                    const std::optional<messages::Bearing>& bearing) {
  const sonar::SnrCurve curve = falling();
  const NorthEast source{Meters{12'000.0}, Meters{15'000.0}};
  NorthEast place{Meters{8'000.0}, Meters{6'000.0}};
  const auto memory = std::make_unique<policy::SearchMemory>();
  std::vector<RecordedDecision> taken;
  for (std::size_t i = 0; i < decisions; ++i) {
    RecordedDecision d;
    d.step = static_cast<std::uint32_t>(i);
    d.time = Time{} + Duration::seconds(500 * static_cast<std::int64_t>(i));
    d.position = south_west + place;
    const policy::Reception reception = hear(curve.at(range_between(place, source)));
    d.snr = reception.snr;
    d.too_faint = reception.too_faint;
    d.bearing = bearing;
    d.detected = !d.too_faint && d.snr >= policy.detection_threshold;
    i == 0 ? memory->start(policy.observation, falling_ocean(), d.position - south_west, d.reception())
           : memory->remember(policy.observation, falling_ocean(), d.position - south_west, d.reception());
    d.observation_size = static_cast<std::uint8_t>(policy.observation.spec.size());
    d.action_count = static_cast<std::uint8_t>(policy.actions.size());
    const std::span<float> logits = std::span(d.logits).first(d.action_count);
    policy::observe(*memory, policy.observation, std::span(d.observation).first(d.observation_size));
    policy::find_logits(policy, d.observed(), logits);
    d.action = static_cast<std::uint8_t>(std::ranges::max_element(logits) - logits.begin());
    // Towards the middle, whatever it chose: a random policy would leave.
    place = place + NorthEast{Meters{400.0}, Meters{700.0}};
    d.waypoint = south_west + place;
    taken.push_back(d);
  }
  return taken;
}

}  // namespace earshot::explain
