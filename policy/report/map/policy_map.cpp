#include "policy/report/map/policy_map.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/place.hpp"
#include "policy/command_line/policy_details.hpp"
#include "policy/command_line/scenario_options.hpp"
#include "policy/evaluate/world_file.hpp"
#include "policy/explain/replay.hpp"
#include "policy/report/map/action_map_plot.hpp"
#include "policy/report/recorded_flight.hpp"
#include "sim/search/scenario/scenario_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::report {
namespace {

using host::BadInput;

/// The likeliest ocean beforehand.
const policy::OceanTable& expected_in(const policy::OceanTables& tables) {
  return *std::ranges::max_element(tables.tables, {}, &policy::OceanTable::prior);
}

/// What is heard at each range from the source, and for which frequency and depths that holds.
struct Heard {
  sonar::SnrCurve curve;
  std::string conditions;
};

std::string meters(Meters depth) {
  return host::significant(depth.value, 4);
}

/// "source of 20 Hz, 30 m deep; vehicle 300 m deep"; of tables for several depths "source of 20 Hz (the tables hold sources 10 to 50 m
/// deep); vehicle 300 m deep"
std::string conditions_of(Hertz frequency, policy::DepthRange source, Meters vehicle) {
  const std::string depths = source.least == source.most
                                 ? ", " + meters(source.least) + " m deep"
                                 : " (the tables hold sources " + meters(source.least) + " to " + meters(source.most) + " m deep)";
  return "source of " + host::significant(frequency.value, 4) + " Hz" + depths + "; vehicle " + meters(vehicle) + " m deep";
}

/// In the likeliest ocean of its tables, where nobody says otherwise.
Heard heard_by(const policy::FrozenPolicy& policy, const PolicyMapOptions& options, const policy::OceanTables& tables) {
  if (!options.world && !options.environment) {
    if (!policy::needs_belief(policy.observation.spec))
      throw BadInput("--environment: " + options.policy.string() + " searches by no ocean tables: name an environment file (TOML)");
    std::vector<float> snr_db(tables.range_count);
    for (std::size_t i = 0; i < snr_db.size(); ++i) snr_db[i] = expected_in(tables).snr_db(i);
    return {{tables.range_step, std::move(snr_db)}, conditions_of(tables.frequency, tables.source_depth, tables.receiver_depth)};
  }
  const std::filesystem::path& file = options.world ? *options.world : *options.environment;
  const ocean::Environment environment = (options.world ? evaluate::load_world(file).scenario : search::load_scenario(file)).environment;
  host::DistinctFiles files;
  files.read(options.world ? "a file of --world" : "a file of --environment", environment.files);
  files.write("--output", options.output);
  const Meters depth{options.vehicle_depth_m};
  command_line::check_vehicle_depth(environment, file, depth);
  try {
    return {sonar::compute_snr_curve(environment, depth, length_of(policy.area_size)),
            conditions_of(environment.source.frequency, {environment.source.depth, environment.source.depth}, depth)};
  } catch (const std::invalid_argument& e) {
    throw BadInput(file.string() + ": " + e.what());
  }
}

std::string heard_in(const PolicyMapOptions& options) {
  if (options.world) return "what is heard in " + options.world->filename().string();
  if (options.environment) return "what is heard in " + options.environment->filename().string();
  return "what is heard in the likeliest ocean of the tables";
}

MapOcean ocean_of(const policy::FrozenPolicy& policy, const PolicyMapOptions& options, const Heard& heard, NorthEast heard_from,
                  std::optional<NorthEast> source) {
  return {.policy = policy,
          .policy_name = options.policy.filename().string(),
          .curve = heard.curve,
          .heard_from = heard_from,
          .words = heard_in(options),
          .conditions = heard.conditions,
          .source = source};
}

NorthEast source_in(const policy::FrozenPolicy& policy, const std::string& text) {
  const NorthEast source = command_line::north_east_of("--source", text);
  const auto is_within = [](Meters x, Meters most) { return x.value >= 0.0 && x <= most; };
  if (is_within(source.north, policy.area_size.north) && is_within(source.east, policy.area_size.east)) return source;
  throw BadInput("--source " + text + ": outside the policy's area, " +
                 host::formatted("0,0 to %.10g,%.10g m", policy.area_size.north.value, policy.area_size.east.value));
}

/// Empty for a policy that needs none.
std::unique_ptr<policy::OceanTables> tables_of(const policy::FrozenPolicy& policy, const PolicyMapOptions& options) {
  if (!policy::needs_belief(policy.observation.spec)) return std::make_unique<policy::OceanTables>();
  return host::tables_from(host::read_tables_bytes(options.tables), options.tables);
}

void draw_for_source(const policy::FrozenPolicy& policy, const PolicyMapOptions& options) {
  const NorthEast source = source_in(policy, *options.source);
  const std::unique_ptr<policy::OceanTables> tables = tables_of(policy, options);
  const Heard heard = heard_by(policy, options, *tables);
  const auto reception_at = [&](NorthEast place) { return policy::Reception{.snr = heard.curve.at(range_between(place, source))}; };
  const MapOcean ocean = ocean_of(policy, options, heard, source, source);
  if (explain::sees_place_alone(policy)) {
    draw_arrows(options.output, ocean, explain::after_a_first_measurement(policy, *tables, options.arrows, reception_at), "where it goes");
  } else {
    const auto paths = explain::flown_from_all_over(policy, *tables, source, {.per_side = options.starts}, reception_at);
    draw_paths(options.output, ocean, paths);
  }
}

void draw_for_flight(const policy::FrozenPolicy& policy, const PolicyMapOptions& options) {
  const RecordedFlight flight = open_recording(*options.flight, {.policy = options.policy});
  if (!policy::needs_belief(policy.observation.spec))
    throw BadInput("--flight: " + options.policy.string() + " holds no belief that could be followed along a flight");
  const auto taken = std::span(flight.journal.decisions).first(index_of_step(flight, options.step) + 1);
  const explain::ActionMap map = explain::standing_elsewhere(
      policy, *flight.tables, options.arrows, *explain::remembered_at(policy.observation, *flight.tables, taken, flight.south_west));
  const explain::DecisionAccount account = explain::account_of(flight.circumstances(explain::Baseline::kCentre), taken);
  const Heard heard = heard_by(policy, options, *flight.tables);
  const std::optional<NorthEast> source = flight.source ? std::optional(*flight.source - flight.south_west) : std::nullopt;
  const MapOcean ocean = ocean_of(policy, options, heard, source.value_or(account.place.likeliest), source);
  draw_arrows(options.output, ocean, map, "where it would go with what it believes at step " + std::to_string(options.step),
              MapFlight{.belief = account, .track = taken});
}

/// No file that is read may be the picture: --force would replace it.
void check_picture(const PolicyMapOptions& options) {
  command_line::check_picture_name("-o", options.output);
  host::DistinctFiles read;
  read.read("POLICY", options.policy);
  read.read("--tables", options.tables);
  if (options.environment) read.read("--environment", *options.environment);
  if (options.world) read.read("--world", *options.world);
  if (options.flight) read.read("--flight", files_of_flight(*options.flight));
  host::require_writable(std::move(read), std::array{host::Output{"--output", options.output, host::picture_kind(options.output)}},
                         host::replaced_by(options.force));
}

}  // namespace

void draw_policy_map(const PolicyMapOptions& options) {
  check_picture(options);
  const std::unique_ptr<policy::FrozenPolicy> policy = host::load_unverified_policy(options.policy);
  if (options.source.has_value() == options.flight.has_value())
    throw BadInput("earshot explain map: one of --source NORTH_M,EAST_M and --flight DIR is needed");
  command_line::print_policy_details(options.policy.string(), *policy);
  if (options.source)
    draw_for_source(*policy, options);
  else
    draw_for_flight(*policy, options);
  program::print() << "wrote " << options.output.string() << ": " << heard_in(options) << "\n";
}

}  // namespace earshot::report
