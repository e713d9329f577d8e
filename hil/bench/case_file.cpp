#include <algorithm>
#include <numbers>
#include <string_view>

#include "firmware/core/math.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/safety/supervisor.hpp"
#include "hil/bench/case.hpp"
#include "hil/nodes/emulated_vehicle.hpp"

namespace earshot::hil {
namespace {

using host::PortKind;
using host::Range;
using host::TableReader;

using EndWord = messages::Word<messages::EndReason>;
constexpr const auto& kEnds = messages::WordsOf<messages::EndReason>::kTable;

template <class Traits>
std::vector<std::string> words_of(const Traits& all, std::string_view Traits::value_type::*word) {
  std::vector<std::string> words;
  for (const auto& traits : all) words.emplace_back(traits.*word);
  return words;
}

/// Index of the first port that takes a hydrophone's samples; 0: none.
std::uint8_t sound_port_of(const std::vector<host::PortSettings>& ports) {
  const auto found = std::ranges::find_if(ports, [](const host::PortSettings& port) { return port.roles.has(host::Role::kHydrophone); });
  return found == ports.end() ? std::uint8_t{0} : static_cast<std::uint8_t>(found - ports.begin() + 1);
}

/// Samples come over LCM, whatever bus the rest comes by.
/// @throws host::BadInput unless all its other ports are on one kind of bus
PortKind bus_of(const host::MissionFile& mission, const std::filesystem::path& path) {
  std::vector<host::PortSettings> ports = mission.ports;
  std::erase_if(ports, [](const host::PortSettings& port) { return port.roles.has(host::Role::kHydrophone); });
  const bool is_of_one = std::ranges::all_of(ports, [&](const host::PortSettings& port) { return port.kind == ports.front().kind; });
  if (ports.empty() || !is_of_one)
    throw host::BadInput(host::printable(path.string()) + ": the bench flies missions whose ports are all over CAN, or all over LCM");
  return ports.front().kind;
}

bool is_on(FaultBus fault, PortKind bus) {
  return fault == FaultBus::kEither || (fault == FaultBus::kLcm) == (bus == PortKind::kLcm);
}

std::vector<std::string> senders(PortKind bus) {
  if (bus == PortKind::kLcm) return {std::begin(kLcmSenders), std::end(kLcmSenders)};
  std::vector<std::string> names(std::begin(kDeviceNames), std::end(kDeviceNames));
  names.emplace_back(kEarshotsFrames);
  return names;
}

Time seconds_from_start(double seconds) {
  return Time{static_cast<std::int64_t>(seconds * 1e6)};
}

NorthEast place_of(TableReader& table, std::string_view key, NorthEast fallback) {
  if (!table.has(key)) return fallback;
  const std::vector<double> numbers = table.numbers(key, Range::between(-1e6, 1e6));
  if (numbers.size() == 2) return {Meters{numbers[0]}, Meters{numbers[1]}};
  if (!table.is_noted(key)) table.problem(key, "two numbers: metres north and east of the mission's origin");
  return fallback;
}

bool is_flown(FaultFlight fault, bool is_at_sea) {
  return fault == FaultFlight::kEither || (fault == FaultFlight::kAtSea) == is_at_sea;
}

void read_whom(TableReader& table, TimedFault& fault) {
  const std::vector<std::string> subjects(fault.traits().subjects.begin(), fault.traits().subjects.end());
  if (subjects.empty()) return;
  fault.device = subjects.front();
  if (table.has("of")) fault.device = subjects.at(table.choice("of", subjects));
}

/// What tc takes for netem, which judges it.
std::string read_netem(TableReader& table) {
  std::string how = table.text("how");
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789.% ";
  if (how.find_first_not_of(kAllowed) != std::string::npos)
    table.problem("how", "must be words of tc-netem(8): \"delay 50ms 20ms loss 5%\"");
  return how;
}

/// @param c  the case, as far as it is read: its bus, its time, its speed
TimedFault read_fault(TableReader table, const Case& c) {
  const PortKind bus = c.bus;
  const bool is_at_sea = c.speed.has_value();
  constexpr double kLongest = 1e6;
  TimedFault fault;
  const std::size_t index = table.choice("kind", words_of(kFaultTraits, &FaultTraits::word));
  const FaultTraits& traits = kFaultTraits.at(index);
  fault.fault = static_cast<Fault>(index);
  if (!is_on(traits.bus, bus))
    table.problem("kind", std::string("there is no ") + std::string(traits.word) + " over " + (bus == PortKind::kLcm ? "LCM" : "CAN") +
                              ", the mission's bus");
  if (!is_flown(traits.flight, is_at_sea))
    table.problem("kind",
                  std::string("there is no ") + std::string(traits.word) + (is_at_sea ? " in a case with a speed" : " in lock-step"));
  fault.from = seconds_from_start(table.number("at_s", Range::between(0.0, kLongest)));
  if (fault.from - Time{} >= c.at_most && !table.is_noted("at_s")) table.problem("at_s", "the flight is over by then (at_most_s)");
  if (table.has("for_s")) fault.until = fault.from + Duration{seconds_from_start(table.number("for_s", Range::between(0.1, kLongest))).us};
  if (!traits.amount.empty()) fault.amount = table.number(traits.amount, Range::between(traits.lowest, traits.highest));
  if (traits.has_direction) fault.direction_deg = table.number_or("towards_deg", 0.0, Range::between(-360.0, 360.0));
  if (is_at_sea) read_whom(table, fault);
  if (fault.fault == Fault::kNetem) fault.how = read_netem(table);
  if (traits.hits != FaultTarget::kFrames) return fault;
  fault.share = table.number_or("share", 1.0, Range::between(0.0, 1.0));
  if (table.has("of")) fault.device = senders(bus).at(table.choice("of", senders(bus)));
  if (bus == PortKind::kCan && table.has("pgn")) fault.pgn = static_cast<std::uint32_t>(table.integer("pgn", 0, 0x3FFFF));
  return fault;
}

/// @param mission  nothing: that of the case cannot be read
Expectation read_expectation(TableReader table, const std::optional<host::MissionFile>& mission, bool is_at_sea) {
  Expectation expected;
  expected.end = kEnds.at(table.choice("end", words_of(kEnds, &EndWord::key))).value;
  if (table.has("rules")) {
    for (const std::size_t index : table.choices("rules", words_of(config::kConditionTraits, &config::ConditionTraits::key)))
      expected.rules.push_back(static_cast<config::Condition>(index));
  }
  const safety::Rules rules = mission ? safety::rules_of(mission->mission) : safety::Rules{};
  for (const config::Condition rule : expected.rules) {
    if (mission && std::ranges::find(rules, rule, &config::Rule::condition) == rules.end())
      table.problem("rules", "the mission has no rule " + key_of(rule));
  }
  expected.only_these = !table.boolean_or("others_may_fire", false);
  if (table.has("refuses_navigation")) expected.refuses_navigation = table.boolean_or("refuses_navigation", false);
  if (table.has("refuses_commands")) expected.refuses_commands = table.boolean_or("refuses_commands", false);
  expected.loses_nothing = table.boolean_or("loses_nothing", false);
  expected.decisions = table.integer_or("decisions", 0, 0, 1'000);
  expected.comes_up = table.boolean_or("comes_up", false);
  expected.releases_weight = table.boolean_or("releases_weight", false);
  expected.refuses_frames = table.boolean_or("refuses_frames", false);
  expected.refuses_to_fly = table.boolean_or("refuses_to_fly", false);
  for (const char* key : {"refuses_frames", "refuses_to_fly"}) {
    if (table.has(key) && !is_at_sea) table.problem(key, "only in a case with a speed");
  }
  return expected;
}

}  // namespace

Radians Case::start_heading() const {
  return wrap_to_pi(Radians{start_heading_deg * std::numbers::pi / 180.0});
}

bool Case::has(Fault fault) const {
  return std::ranges::find(faults, fault, &TimedFault::fault) != faults.end();
}

bool Case::has(FaultTarget target) const {
  return std::ranges::any_of(faults, [target](const TimedFault& fault) { return fault.traits().hits == target; });
}

std::string key_of(config::Condition rule) {
  return std::string(config::kConditionTraits.at(static_cast<std::size_t>(rule)).key);
}

Case load_case(const std::filesystem::path& path, const std::filesystem::path& usual_mission) {
  const host::TomlFile file(path);
  TableReader root = file.root();
  Case made;
  made.name = path.stem().string();
  made.given = root.text("given");
  made.when = root.text("when");
  made.then = root.text("then");
  made.defence = root.text_or("defence", "");
  made.mission = root.has("mission") ? file.resolve(root.text("mission")) : usual_mission;
  std::optional<host::MissionFile> mission;
  if (std::filesystem::exists(made.mission)) {
    mission = host::load_mission(made.mission);
    made.bus = bus_of(*mission, made.mission);
    made.sound_port = sound_port_of(mission->ports);
  } else if (!root.is_noted("mission")) {
    root.problem("mission", "there is no " + host::printable(made.mission.lexically_normal().string()));
  }
  made.start = place_of(root, "start_m", {Meters{12'500}, Meters{11'000}});
  made.start_heading_deg = root.number_or("start_heading_deg", 0.0, Range::between(-360.0, 360.0));
  made.source = place_of(root, "source_m", {Meters{12'500}, Meters{12'500}});
  made.at_most = Duration::seconds(root.integer_or("at_most_s", 3600, 10, 1'000'000));
  if (root.has("speed")) made.speed = root.number("speed", Range::between(0.1, 100.0));
  if (made.speed && made.bus != PortKind::kCan) root.problem("speed", "only of a mission over CAN");
  if (root.has("fault")) {
    for (const TableReader& table : root.tables("fault")) made.faults.push_back(read_fault(table, made));
  }
  if (made.sound_port == 0 && made.has(FaultTarget::kSound))
    root.problem("mission", "must have a port of the role \"hydrophone\", for faults in its samples");
  made.expected = read_expectation(root.table("expect"), mission, made.speed.has_value());
  file.finish();
  return made;
}

std::vector<Case> load_cases(const std::filesystem::path& folder, const std::filesystem::path& usual_mission) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<Case> cases;
  for (const std::filesystem::path& file : files) cases.push_back(load_case(file, usual_mission));
  return cases;
}

}  // namespace earshot::hil
