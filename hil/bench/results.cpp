#include "hil/bench/results.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "hil/bench/vehicle_bus.hpp"

namespace earshot::hil {
namespace {

using nlohmann::json;

double seconds(Time time) {
  return static_cast<double>(time.us) / 1e6;
}

json place(NorthEast at) {
  return json::array({at.north.value, at.east.value});
}

json polygon_of(const config::Mission& mission) {
  json corners = json::array();
  if (mission.safety.fence) {
    for (const NorthEast& corner : mission.safety.fence->halt) corners.push_back(place(corner));
    return corners;
  }
  const Rectangle& area = mission.operating_area;
  for (const NorthEast& corner : {area.south_west, NorthEast{area.north_east.north, area.south_west.east}, area.north_east,
                                  NorthEast{area.south_west.north, area.north_east.east}})
    corners.push_back(place(corner));
  return corners;
}

json event_of(const messages::SafetyEvent& event) {
  return {{"time_s", seconds(event.time)}, {"rule", key_of(event.condition)},
          {"begins", event.begins},        {"response", messages::key_of(event.response)},
          {"measure", event.measure},      {"limit", event.limit}};
}

json frame_of(const TracedFrame& traced) {
  std::ostringstream data;
  data << std::hex << std::setfill('0');
  for (const std::uint8_t byte : traced.frame.bytes()) data << std::setw(2) << unsigned{byte};
  const Result<n2k::Identifier> identifier = n2k::parse_identifier(traced.frame.identifier);
  return {{"time_s", seconds(traced.time)},
          {"from_earshot", traced.from_earshot},
          {"pgn", identifier.ok() ? identifier.value().pgn : 0},
          {"source", identifier.ok() ? identifier.value().source : 0},
          {"data", data.str()}};
}

json frame_of(const TracedMessage& traced) {
  constexpr std::size_t kMostBytes = 64;  // of a message: health has hundreds
  std::ostringstream data;
  data << std::hex << std::setfill('0');
  for (const std::uint8_t byte : std::span(traced.message.data).first(std::min(traced.message.data.size(), kMostBytes)))
    data << std::setw(2) << unsigned{byte};
  return {{"time_s", seconds(traced.time)},
          {"from_earshot", traced.from_earshot},
          {"pgn", 0},
          {"source", 0},
          {"channel", host::printable(traced.message.channel)},
          {"data", data.str()}};
}

/// Null: it may be so or not.
json wish(std::optional<bool> wanted) {
  return wanted ? json(*wanted) : json(nullptr);
}

/// When a fault ceases to act; nothing: it does not.
json end_of(const TimedFault& fault) {
  if (fault.traits().is_of_a_moment) return seconds(fault.from + kTick);
  return fault.until ? json(seconds(*fault.until)) : json(nullptr);
}

/// What a reader of a case wants to see of the bus: the frames around the first rule that fired, or the last.
template <class Traced>
json trace_of(const std::deque<Traced>& trace, const std::vector<messages::SafetyEvent>& events) {
  constexpr Duration kBefore = Duration::seconds(5);
  constexpr Duration kAfter = Duration::seconds(2);
  constexpr std::ptrdiff_t kMostBefore = 300;
  constexpr std::ptrdiff_t kMostAfter = 100;
  if (trace.empty()) return json::array();
  const auto fired = std::ranges::find_if(events, &messages::SafetyEvent::begins);
  const bool is_kept = fired != events.end() && fired->time >= trace.front().time;
  const Time moment = is_kept ? fired->time : trace.back().time;
  const auto behind = std::ranges::upper_bound(trace, moment, {}, &Traced::time);
  const auto earliest = std::ranges::lower_bound(trace, Time{moment.us - kBefore.us}, {}, &Traced::time);
  const auto latest = std::ranges::upper_bound(trace, moment + kAfter, {}, &Traced::time);
  json frames = json::array();
  std::for_each(behind - std::min(behind - earliest, kMostBefore), behind + std::min(latest - behind, kMostAfter),
                [&frames](const Traced& frame) { frames.push_back(frame_of(frame)); });
  return frames;
}

}  // namespace

struct Results::Content {
  json cases = json::array();
  std::size_t passed = 0;
};

Results::Results() : content_(std::make_unique<Content>()) {}
Results::~Results() = default;

void Results::add(const Case& c, const config::Mission& mission, const BenchFlight& flight, const JournalFindings& journal,
                  const std::vector<std::string>& wrong) {
  json faults = json::array();
  for (const TimedFault& fault : c.faults)
    faults.push_back({{"words", to_string(fault)}, {"from_s", seconds(fault.from)}, {"until_s", end_of(fault)}});
  json expected_rules = json::array();
  for (const config::Condition rule : c.expected.rules) expected_rules.push_back(key_of(rule));
  json events = json::array();
  for (const messages::SafetyEvent& event : journal.events) events.push_back(event_of(event));
  json track = json::array();
  constexpr std::size_t kMostPlaces = 500;
  const std::size_t every = flight.track.size() / kMostPlaces + 1;
  for (std::size_t i = 0; i < flight.track.size(); i += every)
    track.push_back({seconds(flight.track[i].time), flight.track[i].position.north.value, flight.track[i].position.east.value,
                     flight.track[i].depth.value});
  content_->cases.push_back(
      {{"name", c.name},
       {"given", c.given},
       {"when", c.when},
       {"then", c.then},
       {"bus", c.bus == host::PortKind::kLcm ? "LCM" : "CAN"},
       {"defence", c.defence},
       {"passed", wrong.empty()},
       {"wrong", wrong},
       {"faults", faults},
       {"expected_end", messages::to_string(c.expected.end)},
       {"expected_rules", expected_rules},
       {"others_may_fire", !c.expected.only_these},
       {"refuses_navigation", wish(c.expected.refuses_navigation)},
       {"refuses_commands", wish(c.expected.refuses_commands)},
       {"loses_nothing", c.expected.loses_nothing},
       {"least_decisions", c.expected.decisions},
       {"comes_up", c.expected.comes_up},
       {"releases_weight", c.expected.releases_weight},
       {"refuses_frames", c.expected.refuses_frames},
       {"refuses_to_fly", c.expected.refuses_to_fly},
       {"end", messages::to_string(flight.end)},
       {"events", events},
       {"setpoints", journal.setpoints},
       {"navigation_refused", journal.counters.navigation_refused},
       {"commands_refused", journal.counters.commands_refused},
       {"at_sea_s", seconds(flight.last)},
       {"wall_s", flight.wall_s},
       {"frames_sent", flight.sent},
       {"frames_received", flight.received},
       {"frames_lost_by_kernel", flight.lost},
       {"frames_afflicted", flight.afflicted},
       {"start_m", place(c.start)},
       {"source_m", place(c.source)},
       {"halt_polygon_m", polygon_of(mission)},
       {"track", track},
       {"trace", flight.messages.empty() ? trace_of(flight.trace, journal.events) : trace_of(flight.messages, journal.events)}});
  if (wrong.empty()) ++content_->passed;
}

std::size_t Results::passed() const {
  return content_->passed;
}

std::string Results::text() const {
  return json{{"cases", content_->cases}}.dump(1) + "\n";
}

}  // namespace earshot::hil
