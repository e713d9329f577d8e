#include "firmware/desk/replay_view/parting_map.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "firmware/desk/map/svg_map.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::replay_view {
namespace {

using board::SvgMap;

constexpr SvgMap::Style kArea{"none", "#e8eef3", 0, ""};
constexpr SvgMap::Style kTrack{"#5b6b78", "none", 1.4, ""};
constexpr SvgMap::Style kThen{"#0b57a4", "none", 5.0, ""};
constexpr SvgMap::Style kNow{"#d55e00", "none", 2.0, "7 4"};
constexpr SvgMap::Dot kThenHere{"#0b57a4", "white", 4.5, 1};
constexpr SvgMap::Dot kNowHere{"white", "#d55e00", 3, 2};
constexpr SvgMap::Dot kParting{"none", "#b3261e", 12, 3};

/// A map of the flight, not of the area, of which a search may see little; a kilometre about everything.
std::vector<NorthEast> places_of(const Counterfactual& counterfactual, std::span<const StepPair> pairs, const Rectangle& area) {
  std::vector<NorthEast> places = counterfactual.track;
  for (const StepPair& pair : pairs) {
    for (const auto* decision : {&pair.then, &pair.now}) {
      if (*decision) places.insert(places.end(), {(*decision)->position, (*decision)->waypoint});
    }
  }
  if (places.empty()) return board::corners_of(area);
  constexpr NorthEast kAbout{Meters{1000}, Meters{1000}};
  for (std::size_t i = places.size(); i > 0; --i) places.insert(places.end(), {places[i - 1] - kAbout, places[i - 1] + kAbout});
  return places;
}

/// What both share; no rectangle (its corners are not in it) where they do not touch.
Rectangle common(const Rectangle& a, const Rectangle& b) {
  return {{std::max(a.south_west.north, b.south_west.north), std::max(a.south_west.east, b.south_west.east)},
          {std::min(a.north_east.north, b.north_east.north), std::min(a.north_east.east, b.north_east.east)}};
}

}  // namespace

std::string parting_map(const Counterfactual& counterfactual, std::span<const StepPair> pairs, std::uint32_t from_step,
                        const Rectangle& area, const std::string& title) {
  const std::span<const StepPair> drawn = from(from_step, pairs);
  SvgMap map(places_of(counterfactual, pairs, area), title);
  if (const Rectangle seen = common(area, map.shown()); seen.contains(seen.south_west)) map.polygon(board::corners_of(seen), kArea);
  map.line(counterfactual.track, kTrack);
  const auto draw = [&](std::optional<messages::Decision> StepPair::*decision, const SvgMap::Style& way, const SvgMap::Dot& end) {
    for (const StepPair& pair : drawn) {
      if (const auto& d = pair.*decision) map.line(std::array{d->position, d->waypoint}, way);
    }
    for (const StepPair& pair : drawn) {
      if (const auto& d = pair.*decision) map.dot(d->waypoint, end);
    }
  };
  draw(&StepPair::then, kThen, kThenHere);
  draw(&StepPair::now, kNow, kNowHere);
  map.legend(kArea, "search area");
  map.legend_line(kTrack, "track", "as navigated on the flight");
  map.legend_line(kThen, "decided then", "to the way-point at its dot");
  map.legend_line(kNow, "decided now", "from where the vehicle was then");
  if (const StepPair* const parts = parting(pairs)) {
    const messages::Decision& d = parts->then ? *parts->then : *parts->now;
    map.dot(d.position, kParting);
    map.words_at(d.position, host::formatted("they part at step %u", static_cast<unsigned>(parts->step)), kParting.stroke);
    map.legend(kParting, host::formatted("they part at step %u", static_cast<unsigned>(parts->step)), "nothing is predicted after it:");
    map.legend_note("fixes and SNRs are those of the");
    map.legend_note("vehicle that followed the journal");
  } else {
    map.legend_note("the decisions do not part");
  }
  return map.svg();
}

}  // namespace earshot::replay_view
