#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {
namespace {

/// Columns whose ranges are found side by side: how far east one lies is found once for all its rows.
constexpr std::size_t kColumnsAtOnce = 32;

/// Where a place beyond an edge is, had it turned back there, and at the other edge, as often as it met one. @param width  > 0
float turned_back(float place, float width) {
  const float turns = place / (2.0F * width);
  const int whole = static_cast<int>(turns) - (turns < 0.0F ? 1 : 0);
  const float off = place - 2.0F * width * static_cast<float>(whole);
  return off > width ? 2.0F * width - off : off;
}

/// Which of the cells of one axis holds a place.
std::uint16_t index_of(float place, float size, std::size_t count) {
  const auto last = static_cast<float>(count - 1);
  return static_cast<std::uint16_t>(static_cast<int>(std::clamp(place / size, 0.0F, last)));
}

}  // namespace

void CellPlaces::find(const BeliefModel& model, const Drift& drift, std::uint32_t measurements, NorthEast corner) {
  const NorthEast way = way_of(drift, model, measurements);
  const auto find_axis = [&drift](std::span<float> places, double cell, Meters drifted, Meters from) {
    const auto width = static_cast<float>(cell * static_cast<double>(places.size()));
    const auto size = static_cast<float>(cell);
    const auto shift = static_cast<float>(drifted.value);
    const auto origin = static_cast<float>(from.value);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const float place = (static_cast<float>(i) + 0.5F) * size + shift;
      places[i] = (drift.is_current ? place : turned_back(place, width)) - origin;
    }
  };
  const std::span<float> places(places_);
  find_axis(places.first(model.cells_north), cell_north(model), way.north, corner.north);
  find_axis(places.subspan(model.cells_north, model.cells_east), cell_east(model), way.east, corner.east);
}

EARSHOT_WIDE void CellPlaces::find_ranges(const BeliefModel& model, NorthEast position, Meters range_step, std::size_t last,
                                          std::span<std::uint16_t> ranges) const {
  const auto per_step = static_cast<float>(1.0 / range_step.value);
  const auto vehicle_north = static_cast<float>(position.north.value);
  const auto vehicle_east = static_cast<float>(position.east.value);
  const auto furthest = static_cast<float>(last);
  const std::size_t columns = model.cells_east;  // a copy: what is written below could otherwise be it
  std::array<float, kColumnsAtOnce> squares;     // of how far east the columns lie
  for (std::size_t first = 0; first < columns; first += kColumnsAtOnce) {
    const std::size_t count = std::min(kColumnsAtOnce, columns - first);
    const float* const column_places = &places_[model.cells_north + first];
    for (std::size_t e = 0; e < count; ++e) {
      const float east = (column_places[e] - vehicle_east) * per_step;
      squares[e] = east * east;
    }
    for (std::size_t n = 0; n < model.cells_north; ++n) {
      const float north = (places_[n] - vehicle_north) * per_step;
      std::uint16_t* const row = &ranges[n * columns + first];
      for (std::size_t e = 0; e < count; ++e)
        row[e] = static_cast<std::uint16_t>(static_cast<int>(lesser(__builtin_sqrtf(north * north + squares[e]) + 0.5F, furthest)));
    }
  }
}

NorthEast CellPlaces::place(const BeliefModel& model, std::size_t cell) const {
  return {Meters{double{places_[cell / model.cells_east]}}, Meters{double{places_[model.cells_north + cell % model.cells_east]}}};
}

void CellPlaces::find_axes(const BeliefModel& model, std::span<std::uint16_t> axes) const {
  const auto size_north = static_cast<float>(cell_north(model));
  const auto size_east = static_cast<float>(cell_east(model));
  const std::size_t rows = model.cells_north;
  const std::size_t columns = model.cells_east;
  for (std::size_t n = 0; n < rows; ++n) axes[n] = static_cast<std::uint16_t>(index_of(places_[n], size_north, rows) * columns);
  for (std::size_t e = 0; e < columns; ++e) axes[rows + e] = index_of(places_[rows + e], size_east, columns);
}

void CellPlaces::find_cells(const BeliefModel& model, std::span<std::uint16_t> cells) const {
  std::array<std::uint16_t, kMostAxes> axes;
  find_axes(model, axes);
  std::size_t cell = 0;
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    for (std::size_t e = 0; e < model.cells_east; ++e) cells[cell++] = static_cast<std::uint16_t>(axes[n] + axes[model.cells_north + e]);
  }
}

}  // namespace earshot::policy
