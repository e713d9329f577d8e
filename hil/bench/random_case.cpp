#include "hil/bench/random_case.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <utility>

#include "firmware/core/random.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint64_t kStream = 19;
constexpr std::uint64_t kBusStream = 20;

/// One of the pool's that has a fault, which says the mission and its bus: there are faults that only one bus knows.
const Case& drawn(const std::vector<Case>& pool, std::uint64_t seed) {
  Pcg32 random(seed, kBusStream);
  std::vector<const Case*> faulty;
  for (const Case& c : pool) {
    if (!c.faults.empty()) faulty.push_back(&c);
  }
  return faulty.empty() ? pool.front() : *faulty[random.next() % faulty.size()];
}

/// In the search area of the bench's missions, as near to its southern edge as makes a vehicle that sails on meet the fence.
NorthEast place_near_the_fence(Pcg32& random) {
  constexpr double kMost_m = 300.0;
  return {Meters{kMost_m * random.uniform_double()}, Meters{5'000.0 + 15'000.0 * random.uniform_double()}};
}

TimedFault moved(TimedFault fault, Pcg32& random) {
  constexpr std::uint32_t kLatest_s = 200;
  const Time from = Time{} + Duration::seconds(1 + random.next() % kLatest_s);
  if (fault.until) fault.until = from + Duration{(*fault.until - fault.from).us};
  fault.from = from;
  if (fault.traits().has_direction) fault.direction_deg = 360.0 * random.uniform_double() - 180.0;
  return fault;
}

std::string written(NorthEast place) {
  return "[" + host::shortest(place.north.value) + ", " + host::shortest(place.east.value) + "]";
}

void write_fault(std::ostream& out, const TimedFault& fault) {
  const FaultTraits& traits = fault.traits();
  out << "\n[[fault]]\nkind = \"" << traits.word << "\"\nat_s = " << host::shortest((fault.from - Time{}).to_seconds()) << "\n";
  if (fault.until) out << "for_s = " << host::shortest((*fault.until - fault.from).to_seconds()) << "\n";
  if (!traits.amount.empty()) out << traits.amount << " = " << host::shortest(fault.amount) << "\n";
  if (fault.direction_deg != 0.0) out << "towards_deg = " << host::shortest(fault.direction_deg) << "\n";
  if (traits.hits != FaultTarget::kFrames) return;
  out << "share = " << host::shortest(fault.share) << "\n";
  if (!fault.device.empty()) out << "of = \"" << fault.device << "\"\n";
  if (fault.pgn) out << "pgn = " << *fault.pgn << "\n";
}

void write_expectation(std::ostream& out, const Expectation& expected) {
  out << std::boolalpha << "\n[expect]\nend = \"" << messages::key_of(expected.end) << "\"\n";
  std::string rules;
  for (const config::Condition rule : expected.rules) rules += (rules.empty() ? "\"" : ", \"") + key_of(rule) + "\"";
  if (!rules.empty()) out << "rules = [" << rules << "]\n";
  if (!expected.only_these) out << "others_may_fire = true\n";
  if (expected.refuses_navigation) out << "refuses_navigation = " << *expected.refuses_navigation << "\n";
  if (expected.refuses_commands) out << "refuses_commands = " << *expected.refuses_commands << "\n";
  if (expected.loses_nothing) out << "loses_nothing = true\n";
  if (expected.decisions > 0) out << "decisions = " << expected.decisions << "\n";
  if (expected.comes_up) out << "comes_up = true\n";
  if (expected.releases_weight) out << "releases_weight = true\n";
}

}  // namespace

Case random_case(const std::vector<Case>& pool, std::uint64_t seed) {
  Pcg32 random(seed, kStream);
  std::vector<TimedFault> all;
  Case made = drawn(pool, seed);
  for (const Case& c : pool) {
    if (c.bus != made.bus) continue;
    std::ranges::copy_if(c.faults, std::back_inserter(all), [](const TimedFault& fault) { return !fault.traits().leads_away; });
  }
  made.name = "random_" + std::to_string(seed);
  made.given = "a search that begins towards the fence";
  made.then = "no promise is broken";
  made.defence.clear();
  made.start = place_near_the_fence(random);
  made.start_heading_deg = 90.0 + 180.0 * random.uniform_double();
  made.source = made.start - NorthEast{Meters{3'000}, Meters{0}};
  made.at_most = Duration::seconds(400);
  made.expected = {};
  made.faults.clear();
  for (std::size_t i = 0, count = all.empty() ? 0 : 2 + random.next() % 2; i < count; ++i)
    made.faults.push_back(moved(all[random.next() % all.size()], random));
  made.when.clear();
  for (const TimedFault& fault : made.faults) made.when += (made.when.empty() ? "" : "; ") + to_string(fault);
  return made;
}

Case shrunk(Case c, const std::function<bool(const Case&)>& fails) {
  for (std::size_t i = 0; i < c.faults.size() && c.faults.size() > 1;) {
    Case smaller = c;
    smaller.faults.erase(smaller.faults.begin() + static_cast<std::ptrdiff_t>(i));
    if (fails(smaller)) {
      c = std::move(smaller);
    } else {
      ++i;
    }
  }
  return c;
}

std::string to_toml(const Case& c) {
  std::ostringstream out;
  out << "given = " << std::quoted(c.given) << "\nwhen = " << std::quoted(c.when) << "\nthen = " << std::quoted(c.then) << "\n";
  if (!c.defence.empty()) out << "defence = " << std::quoted(c.defence) << "\n";
  out << "mission = " << std::quoted(std::filesystem::absolute(c.mission).lexically_normal().string()) << "\nstart_m = " << written(c.start)
      << "\nsource_m = " << written(c.source) << "\nstart_heading_deg = " << host::shortest(c.start_heading_deg)
      << "\nat_most_s = " << c.at_most.us / 1'000'000 << "\n";
  for (const TimedFault& fault : c.faults) write_fault(out, fault);
  write_expectation(out, c.expected);
  return out.str();
}

}  // namespace earshot::hil
