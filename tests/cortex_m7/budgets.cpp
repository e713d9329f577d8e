// What the core costs a Cortex-M7 in instructions, counted by the emulator (-icount shift=6). Lines "NAME VALUE", then the exit status.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include "firmware/boards/cortex_m7/stack.hpp"
#include "firmware/core/random.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/belief/belief_summary.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/golden.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "tests/bits/eight_directions.hpp"
#include "tests/cortex_m7/emulator.hpp"

namespace {

using namespace earshot;
using emulator::instructions;

struct State {
  policy::Network network;
  policy::ObservationModel model;
  policy::OceanTables tables;
  policy::SearchMemory memory;
  detector::SoundDetector detector;
};
alignas(State) std::array<std::byte, sizeof(State)> room;
/// A second of sound. On a vehicle it lies where its message came in, not on the stack.
constexpr int kRate = 1000;
std::array<float, kRate> samples;
std::array<float, config::kMaxBeliefCells> places;

void print_row(const char* name, std::uint32_t value) {
  emulator::print(name);
  emulator::print(" ");
  emulator::print_number(value);
  emulator::print("\n");
}

void require(bool is_so, const char* what) {
  if (is_so) return;
  emulator::print(what);
  emulator::print("\n");
  emulator::end(2);
}

/// Of 62 elements, two layers of 64, 8 actions.
void measure_network(policy::Network& network) {
  constexpr std::size_t kWidth = 64;
  network.observation_size = 62;
  network.hidden_sizes = {kWidth, kWidth};
  network.action_count = 8;
  Pcg32 random(1);
  const auto draw = [&random](const auto& layer, std::size_t outputs, std::size_t inputs) {
    for (std::size_t output = 0; output < outputs; ++output)
      for (std::size_t input = 0; input < inputs; ++input) layer.weight(output, input) = 0.5F * random.uniform_float() - 0.25F;
  };
  draw(network.layer(0), kWidth, network.observation_size);
  draw(network.layer(1), kWidth, kWidth);
  draw(network.layer(2), network.action_count, kWidth);
  std::array<float, 62> observation;
  for (float& element : observation) element = 2.0F * random.uniform_float() - 1.0F;
  std::array<float, 8> logits;
  const std::uint32_t began = instructions();
  policy::forward(network, observation, logits);
  print_row("forward_pass", instructions() - began);
  require(logits[0] == logits[0], "a logit is no number");
}

void make_search(policy::ObservationModel& model, policy::OceanTables& tables) {
  policy::BeliefModel& belief = model.belief;
  belief.area_size = {Meters{25'000}, Meters{25'000}};
  belief.step_length = Meters{1'000};
  belief.border_width = Meters{1'000};
  belief.detection_threshold = Decibels{10};
  for (const UnitNorthEast& direction : bits::kEightDirections) static_cast<void>(belief.actions.push_back(direction));
  belief.cells_north = belief.cells_east = config::kMaxBeliefCells >= 50 * 50 ? 50 : 25;
  model.spec = policy::belief_state(belief);
  policy::make_golden_tables(belief.area_size, tables);
  const policy::OceanTable first = tables.tables[0];
  while (tables.tables.size() < config::kMaxOceanTables &&
         tables.tables.size() < 32) {  // others, each a little fainter than the one before
    policy::OceanTable table = first;
    for (std::size_t range = 0; range < tables.range_count; ++range)
      table.snr_half_db[range] = static_cast<std::int8_t>(first.snr_half_db[range] - static_cast<int>(range * tables.tables.size() / 64));
    static_cast<void>(tables.tables.push_back(table));
  }
}

/// The most and the mean of what is measured again and again.
struct Account {
  std::uint32_t most = 0;
  std::uint32_t count = 0;
  std::uint64_t sum = 0;
  void take(std::uint32_t value) {
    most = value > most ? value : most;
    sum += value;
    ++count;
  }
  [[nodiscard]] std::uint32_t mean() const { return static_cast<std::uint32_t>(sum / count); }
};

/// Of all updates, and of what follows on them.
struct BeliefAccounts {
  Account updates;
  Account declarations;  ///< updates after which the source is declared found
  /// Updates of four hypotheses, with all that does not depend on how many there are; neither where a search begins nor where it finds.
  Account of_four;
  Account of_four_at_rest;  ///< of measurements at which none of those that are held drifts
  Account observations;
  Account decisions;
  Account slices;
  Account refinements;
};

/// What an update costs however many hypotheses there are: what each action may bring, and what is told of all places.
std::uint32_t cost_beyond_hypotheses(const State& state, NorthEast vehicle) {
  const policy::BeliefModel& belief = state.model.belief;
  const std::span<float> probabilities = std::span(places).first(policy::cell_count(belief));
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    probabilities[i] = state.memory.belief().probability(belief, i / belief.cells_east, i % belief.cells_east);
  std::array<float, config::kMaxTableRanges> by_range;
  for (std::size_t r = 0; r < by_range.size(); ++r) by_range[r] = 1.0F / static_cast<float>(r + 1);
  std::array<policy::RangeSample, config::kMaxTableRanges> foreseen;
  policy::find_samples(by_range, by_range, foreseen);
  std::array<policy::ActionValues, config::kMaxActions> action_values;
  const std::uint32_t began = instructions();
  const messages::BeliefSummary summary = policy::summary_of(belief, probabilities);
  policy::find_action_values(belief, probabilities, {foreseen, state.tables.range_step}, vehicle,
                             std::span(action_values).first(belief.actions.size()));
  const std::uint32_t cost = instructions() - began;
  require(summary.effective_cells > 0.0F && action_values[0].regret >= 0.0F, "no outlook");
  return cost;
}

bool has_drifts(const policy::OceanBelief& belief) {
  bool any = false;
  for (std::size_t i = 0; i < policy::OceanBelief::kHypotheses; ++i) any = any || !belief.hypothesis(i).drift.is_none();
  return any;
}

/// A search of forty measurements, to and fro towards a source, and beside it until it is declared found and for a few more: what was heard
/// is weighed, observed and answered, as in a decision. No bearing is heard. @param draw  which noise
void count_search(State& state, std::uint64_t draw, BeliefAccounts& accounts) {
  constexpr int kMeasurements = 40;
  constexpr NorthEast source{Meters{15'700.0}, Meters{8'700.0}};
  Pcg32 random(draw);
  std::array<float, config::kMaxObservation> observation;
  std::array<float, 8> logits;
  for (int measurement = 0; measurement < kMeasurements; ++measurement) {
    const int way = std::min(measurement, 26);
    const NorthEast place{Meters{2'500.0 + 500.0 * way}, Meters{4'500.0 + 2'000.0 * (way % 4)}};
    const auto range = static_cast<std::size_t>(range_between(place, source) / state.tables.range_step);
    const double expected_db = state.tables.tables[0].snr_db(std::min(range, state.tables.range_count - std::size_t{1}));
    const policy::Reception heard{.snr = Decibels{expected_db + 3.0 * static_cast<double>(random.uniform_float()) - 1.5},
                                  .too_faint = measurement % 7 == 6};
    const std::uint32_t began = instructions();
    if (measurement == 0) {
      state.memory.start(state.model, state.tables, place, heard);
    } else {
      state.memory.remember(state.model, state.tables, place, heard);
    }
    const std::uint32_t updated = instructions();
    policy::observe(state.memory, state.model, std::span(observation).first(state.model.spec.size()));
    const std::uint32_t observed = instructions();
    policy::forward(state.network, std::span(observation).first(state.model.spec.size()), logits);
    const bool is_found = state.memory.belief().declaration().has_value();
    (is_found ? accounts.declarations : accounts.updates).take(updated - began);
    const std::uint32_t decided = instructions();
    const std::uint32_t beyond = cost_beyond_hypotheses(state, place);
    const std::uint32_t with_four = beyond + (updated - began - beyond) / (policy::OceanBelief::kHypotheses / 4);
    if (measurement > 0 && !is_found) accounts.of_four.take(with_four);
    if (measurement > 0 && !is_found && !has_drifts(state.memory.belief())) accounts.of_four_at_rest.take(with_four);
    accounts.observations.take(observed - updated);
    accounts.decisions.take(decided - began);
    std::uint32_t refining = 0;
    bool is_left = true;
    while (is_left) {
      const std::uint32_t slice_began = instructions();
      is_left = state.memory.refine(state.model, state.tables);
      const std::uint32_t slice = instructions() - slice_began;
      accounts.slices.take(slice);
      refining += slice;
    }
    accounts.refinements.take(refining);
  }
}

/// Searches alike, each with a noise of its own: what is heard first decides over how many cells the belief spreads.
void measure_belief(State& state) {
  constexpr std::uint64_t kDraws = 2;
  make_search(state.model, state.tables);
  state.network.observation_size = state.model.spec.size();
  BeliefAccounts accounts;
  for (std::uint64_t draw = 1; draw <= kDraws; ++draw) {
    const std::uint32_t declared = accounts.declarations.count;
    count_search(state, draw, accounts);
    require(accounts.declarations.count == declared + 1, "the source is not declared found once");
  }
  require(accounts.of_four_at_rest.count > 0, "a hypothesis drifts at every look");
  print_row("belief_update_most", accounts.updates.most);
  print_row("belief_update_declared", accounts.declarations.most);
  print_row("belief_update_of_four_most", accounts.of_four.most);
  print_row("belief_update_of_four_at_rest_most", accounts.of_four_at_rest.most);
  print_row("belief_update_of_four_mean", accounts.of_four.mean());
  print_row("belief_update_mean", static_cast<std::uint32_t>((accounts.updates.sum + accounts.declarations.sum) /
                                                             (accounts.updates.count + accounts.declarations.count)));
  print_row("observation_most", accounts.observations.most);
  print_row("decision_most", accounts.decisions.most);
  print_row("decision_mean", accounts.decisions.mean());
  print_row("slice_most", accounts.slices.most);
  print_row("pondering_mean", accounts.refinements.mean());
}

/// One channel at 1 kHz; half a minute of it, in blocks of a second, behind the half minute in which the noise is learnt.
void measure_detector(detector::SoundDetector& detector) {
  require(detector.configure(detector::fin_whale()) == Status::kOk, "the detector refuses its settings");
  Pcg32 random(3);
  std::uint32_t measurements = 0;
  std::uint64_t sum = 0;
  for (int second = 0; second < 60; ++second) {
    for (float& sample : samples) sample = 0.01F * (random.uniform_float() + random.uniform_float() - 1.0F);
    const messages::HydrophoneBlock block{.time = {Duration::seconds(second).us},
                                          .sequence = second,
                                          .first_sample = std::int64_t{second} * kRate,
                                          .sample_rate = Hertz{kRate},
                                          .gain = Decibels{0.0},
                                          .samples_per_channel = kRate,
                                          .overflow_count = 0,
                                          .channels = 1};
    const std::uint32_t began = instructions();
    detector.hear(block, samples);
    while (const std::optional<detector::Estimate> estimate = detector.next()) measurements += estimate->is_snr_measurement() ? 1U : 0U;
    if (second >= 30) sum += instructions() - began;
  }
  print_row("hydrophone_sample", static_cast<std::uint32_t>(sum / (30 * kRate)));
  require(measurements > 0, "the detector heard nothing");
}

/// Fixes of a vehicle, as its NMEA 2000 devices send them.
void measure_can() {
  const n2k::LocalPlane plane = n2k::LocalPlane::about({38.5, -28.0}).value();
  n2k::NavigationReceiver receiver(plane);
  std::uint64_t sum = 0;
  std::uint32_t frames = 0;
  std::uint32_t fixes = 0;
  for (int second = 1; second <= 20; ++second) {
    const Time now{Duration::seconds(second).us};
    const messages::Navigation said{.time = now,
                                    .position = {Meters{1'000.0 + second}, Meters{2'000.0}},
                                    .depth = Meters{300.0},
                                    .heading = Radians{0.5},
                                    .speed = MetersPerSecond{2.0}};
    n2k::NavigationFrames composed;
    require(n2k::compose_navigation(said, plane, 35, composed) == Status::kOk, "no frames");
    for (const n2k::Frame& frame : composed) {
      messages::Navigation heard;
      const std::uint32_t began = instructions();
      const Status status = receiver.accept(frame, now, heard);
      sum += instructions() - began;
      ++frames;
      fixes += status == Status::kOk ? 1U : 0U;
    }
  }
  print_row("can_frame", static_cast<std::uint32_t>(sum / frames));
  require(fixes > 0, "no fix");
}

}  // namespace

int main() {
  auto& state = *new (room.data()) State;
  measure_network(state.network);
  measure_belief(state);
  measure_detector(state.detector);
  print_row("stack_used_by_decision_and_sound", static_cast<std::uint32_t>(stack::most_used()));
  measure_can();
  emulator::end(0);
}
