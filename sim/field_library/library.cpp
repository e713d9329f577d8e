#include "sim/field_library/library.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/field_library/store.hpp"
#include "sim/ocean/section_along.hpp"
#include "sim/parallel/ordered_tasks.hpp"

namespace earshot::field_library {
namespace {

using Numbers = std::vector<std::int32_t>;

/// Room for the fans that are being computed, taken in turn.
class Slots {
 public:
  Slots(const sonar::FanPlan& plan, std::size_t count)
      : radial_(plan.radial.ranges * plan.radial.depth_m.size()), fan_(plan.bearings * radial_), count_(count), values_(fan_ * count) {}
  std::span<float> fan(std::size_t group) { return std::span(values_).subspan(group % count_ * fan_, fan_); }
  std::span<float> radial(std::size_t group, std::size_t bearing) { return fan(group).subspan(bearing * radial_, radial_); }

 private:
  std::size_t radial_;
  std::size_t fan_;
  std::size_t count_;
  std::vector<float> values_;
};

void compute_into(std::span<float> loss_db, const LibraryPlan& plan, NorthEast position, std::size_t bearing) {
  std::vector<float> sea_floor(plan.fan.radial.ranges);
  const ocean::Section section =
      ocean::section_along(plan.environment, position, sonar::bearing_of(bearing, plan.fan.bearings), plan.fan.radial.max_range());
  sonar::compute_radial(section, plan.environment.name, plan.fan.radial, {.transmission_loss_db = loss_db, .sea_floor_depth_m = sea_floor});
}

/// Positions still to do, in order; those without water are marked at once.
Numbers positions_to_do(const std::vector<bool>& in_water, LibraryStore& store, LibrarySummary& summary) {
  Numbers to_do;
  for (std::size_t i = 0; i < in_water.size(); ++i) {
    if (!in_water[i]) {
      ++summary.without_water;
      store.mark(i, PositionState::kNoWater);
    } else if (store.state(i) == PositionState::kDone) {
      ++summary.found;
    } else {
      to_do.push_back(static_cast<std::int32_t>(i));
    }
  }
  return to_do;
}

/// One march for everything.
void write_repeated(const LibraryPlan& plan, const Numbers& to_do, LibraryStore& store, const pe::Progress& progress) {
  if (to_do.empty()) return;
  Slots slots(plan.fan, 1);
  compute_into(slots.radial(0, 0), plan, plan.positions[static_cast<std::size_t>(to_do.front())], 0);
  for (std::size_t j = 1; j < plan.fan.bearings; ++j) std::ranges::copy(slots.radial(0, 0), slots.radial(0, j).begin());
  for (std::size_t i = 0; i < to_do.size(); ++i) {
    store.write(static_cast<std::size_t>(to_do[i]), slots.fan(0));
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(to_do.size()));
  }
}

/// This rank's share of the work: every size-th position. `finished` gets the fans in order.
void compute_share(const LibraryPlan& plan, const Numbers& to_do, std::size_t threads, const parallel::Ranks& ranks,
                   const std::function<void(std::size_t share, std::span<const float>)>& finished) {
  const std::size_t bearings = plan.fan.bearings;
  const std::size_t share = (to_do.size() + ranks.size() - 1 - ranks.rank()) / ranks.size();
  const std::size_t window = 2 + threads / bearings;
  Slots slots(plan.fan, window);
  parallel::run_in_order(
      {.groups = share, .tasks_per_group = bearings, .threads = threads, .window = window},
      [&](std::size_t task) {
        const std::size_t group = task / bearings;
        const auto position = static_cast<std::size_t>(to_do[group * ranks.size() + ranks.rank()]);
        compute_into(slots.radial(group, task % bearings), plan, plan.positions[position], task % bearings);
      },
      [&](std::size_t group) { finished(group, slots.fan(group)); });
}

/// Rank 0: its own fans and those of the others, all in the plan's order.
void collect(const LibraryPlan& plan, const Numbers& to_do, std::size_t threads, parallel::Ranks& ranks, LibraryStore& store,
             const pe::Progress& progress) {
  Slots received(plan.fan, 1);
  const auto write = [&](std::size_t i, std::span<const float> fan) {
    store.write(static_cast<std::size_t>(to_do[i]), fan);
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(to_do.size()));
  };
  compute_share(plan, to_do, threads, ranks, [&](std::size_t share, std::span<const float> fan) {
    const std::size_t first = share * ranks.size();
    write(first, fan);
    for (std::size_t i = first + 1; i < std::min(first + ranks.size(), to_do.size()); ++i) {
      ranks.receive(i - first, received.fan(0));
      write(i, received.fan(0));
    }
  });
}

}  // namespace

LibrarySummary write_library(const std::filesystem::path& path, const LibraryPlan& plan, std::size_t threads, parallel::Ranks& ranks,
                             const pe::Progress& progress) {
  LibrarySummary summary{.computed = 0, .found = 0, .without_water = 0};
  std::optional<LibraryStore> store;
  Numbers to_do;
  if (ranks.rank() == 0) {
    if (LibraryStore::is_finished(path, plan)) {
      summary.found = plan.positions.size();
    } else {
      const std::vector<bool> in_water = positions_in_water(plan);  // whatever is wrong is said before there is a file
      store.emplace(path, plan);
      to_do = positions_to_do(in_water, *store, summary);
    }
  }
  const bool repeated = !sonar::differs_with_place(plan.environment);
  if (!repeated) ranks.share(to_do);
  if (ranks.rank() != 0) {
    if (!repeated) compute_share(plan, to_do, threads, ranks, [&](std::size_t, std::span<const float> fan) { ranks.send(fan); });
    return summary;
  }
  if (!store) return summary;
  if (repeated) {
    write_repeated(plan, to_do, *store, progress);
  } else {
    collect(plan, to_do, threads, ranks, *store, progress);
  }
  store->commit();
  summary.computed = to_do.size();
  return summary;
}

}  // namespace earshot::field_library
