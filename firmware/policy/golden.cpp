#include "firmware/policy/golden.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <span>
#include <string_view>

#include "firmware/core/math.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {
namespace {

bool is_same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_same(NorthEast a, NorthEast b) {
  return is_same(a.north.value, b.north.value) && is_same(a.east.value, b.east.value);
}

bool is_same(const messages::BeliefSummary& a, const messages::BeliefSummary& b) {
  return is_same(a.likeliest, b.likeliest) && is_same(a.mean, b.mean) && is_same(a.spread.value, b.spread.value) &&
         is_same(a.likeliest_share, b.likeliest_share) && is_same(a.effective_cells, b.effective_cells);
}

bool is_same(std::span<const float> a, std::span<const float> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) { return is_same(x, y); });
}

/// The part that does not depend on the policy's sizes: elements that it has not are zero in both.
bool is_same(const GoldenStep& a, const GoldenStep& b) {
  return is_same(a.belief, b.belief) && a.fingerprint == b.fingerprint && is_same(a.observation, b.observation) &&
         is_same(a.logits, b.logits);
}

/// The step as this build flies it, the one before being the last that `memory` knows of.
GoldenStep flown(const FrozenPolicy& policy, const OceanTables& tables, const GoldenStep& step, bool is_first, SearchMemory& memory) {
  const ObservationModel& model = policy.observation;
  is_first ? memory.start(model, tables, step.place, step.reception.heard())
           : memory.remember(model, tables, step.place, step.reception.heard());
  GoldenStep again;
  again.place = step.place;
  again.reception = step.reception;
  if (needs_belief(model.spec)) {
    again.belief = memory.belief().summary();
    again.fingerprint = memory.belief().fingerprint(model.belief);
  }
  const std::span<float> observation = std::span(again.observation).first(model.spec.size());
  observe(memory, model, observation);
  find_logits(policy, observation, std::span(again.logits).first(policy.actions.size()));
  return again;
}

void add_ocean(std::string_view name, OceanTables& tables) {
  [[maybe_unused]] Status status = tables.tables.push_back(OceanTable{});
  assert(status == Status::kOk);
  for (const char letter : name) status = tables.tables[tables.tables.size() - 1].name.push_back(letter);
}

}  // namespace

void make_golden_tables(NorthEast area_size, OceanTables& tables) {
  constexpr int kRanges = static_cast<int>(std::min<std::size_t>(config::kMaxTableRanges, 128));
  constexpr int kAtSource = 100;  // half decibels
  constexpr int kFaintest = -100;
  constexpr int kZones = 40;  // ranges from the beginning of one zone to that of the next
  constexpr int kZone = 6;    // ranges that it is wide
  tables.range_count = static_cast<std::uint16_t>(kRanges);
  tables.range_step = (area_size.north + area_size.east) / static_cast<double>(kRanges - 1);
  tables.tables.clear();
  for (const std::string_view name : {"near", "far", "zones"}) add_ocean(name, tables);
  for (int i = 0; i < kRanges; ++i) {
    const auto at = static_cast<std::size_t>(i);
    tables.tables[0].snr_half_db[at] = static_cast<std::int8_t>(std::max(kAtSource - 2 * i, kFaintest));
    tables.tables[1].snr_half_db[at] = static_cast<std::int8_t>(kAtSource - i);
    tables.tables[2].snr_half_db[at] =
        static_cast<std::int8_t>(i % kZones < kZone ? kAtSource - i / 2 : std::max(kAtSource - 3 * i, kFaintest));
  }
}

void record_golden(FrozenPolicy& policy, SearchMemory& memory, OceanTables& tables) {
  make_golden_tables(policy.area_size, tables);
  for (GoldenTrajectory& trajectory : policy.golden) {
    bool is_first = true;
    for (GoldenStep& step : trajectory) {
      step = flown(policy, tables, step, is_first, memory);
      is_first = false;
    }
  }
}

bool repeats_golden(const FrozenPolicy& policy, SearchMemory& memory, OceanTables& tables) {
  make_golden_tables(policy.area_size, tables);
  const auto all_finite = [](std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return is_finite(value); });
  };
  for (const GoldenTrajectory& trajectory : policy.golden) {
    bool is_first = true;
    for (const GoldenStep& step : trajectory) {
      const GoldenStep again = flown(policy, tables, step, is_first, memory);
      if (!is_same(again, step) || !all_finite(again.logits)) return false;
      is_first = false;
    }
  }
  return true;
}

}  // namespace earshot::policy
