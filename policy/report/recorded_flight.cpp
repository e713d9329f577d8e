#include "policy/report/recorded_flight.hpp"

#include <span>
#include <utility>

#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/json_fault.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/explain/replay.hpp"
#include "sim/search/belief_model.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;
using explain::RecordedDecision;
using host::BadInput;

std::string how_it_ends(const JournalledSearch& journal) {
  return journal.damages.empty() ? "" : "; the journal is cut short or damaged";
}

void require_decisions(const fs::path& path, const JournalledSearch& journal) {
  if (!journal.is_journal()) throw BadInput(path.string() + ": not a journal: no record where the first should begin");
  if (journal.decisions.empty())
    throw NothingToExplain(path.string() + ": no decision in it" + (journal.is_whole() ? "" : ": " + lack_of(journal)));
  for (std::size_t i = 0; i < journal.decisions.size(); ++i) {
    if (journal.decisions[i].step != i)
      throw BadInput(path.string() + ": the decision of step " + std::to_string(i) +
                     " is missing: what was remembered after it cannot be made again");
  }
}

void check_against_policy(const RecordedFlight& flight) {
  const auto memory = std::make_unique<policy::SearchMemory>();
  const policy::ObservationModel& model = flight.policy->observation;
  for (const RecordedDecision& decision : flight.journal.decisions) {
    const NorthEast place = decision.position - flight.south_west;
    if (decision.step == 0)
      memory->start(model, *flight.tables, place, decision.reception());
    else
      memory->remember(model, *flight.tables, place, decision.reception());
    const explain::Contradiction found = explain::contradiction(*flight.policy, decision, *memory);
    if (found != explain::Contradiction::kNone)
      throw BadInput(flight.journal_path.string() + ": " + to_string(found, decision, *flight.policy, flight.policy_path.string()));
  }
}

void read_summary(const fs::path& path, const nlohmann::json& summary, RecordedFlight& flight) try {
  flight.south_west = place_in(summary.at("area").at("south_west"));
  flight.source = place_in(summary.at("source"));
  flight.conditions = conditions_in(summary);
} catch (const nlohmann::json::exception& e) {
  throw BadInput(path.string() + ": " + description::to_string(e));
}

}  // namespace

fs::path file_beside(const fs::path& journal, const std::string& what) {
  if (const std::optional<fs::path> beside = beside_journal(journal, "." + what)) return *beside;
  throw BadInput(journal.string() + ": no " + what + " beside it (" + fs::path(journal).replace_extension("." + what).filename().string() +
                 "): name what flew with --" + what + " FILE");
}

Observer observer_of(const policy::FrozenPolicy& policy, std::span<const SnrRow> snr) {
  std::vector<float> snr_db;
  for (const SnrRow& row : snr) snr_db.push_back(static_cast<float>(row.snr_db));
  const sonar::SnrCurve curve(Meters{snr[1].range_m - snr[0].range_m}, std::move(snr_db));
  const search::SearchSettings settings = evaluate::search_of(policy);
  Observer observer{.belief = search::belief_model(settings), .tables = std::make_unique<policy::OceanTables>()};
  observer.belief.actions = policy.actions;
  search::make_known_ocean(settings, curve, *observer.tables);
  return observer;
}

std::string to_string(explain::Contradiction contradiction, const RecordedDecision& decision, const policy::FrozenPolicy& policy,
                      const std::string& policy_name) {
  const std::string here = "step " + std::to_string(decision.step) + ": ";
  if (contradiction == explain::Contradiction::kSizes)
    return here + "taken by another policy than " + policy_name + ": it saw " + std::to_string(decision.observed().size()) +
           " numbers and had " + std::to_string(decision.action_logits().size()) + " actions, this one sees " +
           std::to_string(policy.observation.spec.size()) + " and has " + std::to_string(policy.actions.size());
  if (contradiction == explain::Contradiction::kLogits)
    return here + "taken by another policy than " + policy_name + ": the same observation gives other logits";
  return here + "what was heard until then gives another observation than " + policy_name +
         " saw: a belief of another version of Earshot, other ocean tables, or the area's south-west corner is elsewhere "
         "(--south-west NORTH_M,EAST_M)";
}

explain::Circumstances RecordedFlight::circumstances(explain::Baseline baseline) const {
  return {.policy = *policy,
          .belief = belief(),
          .tables = *tables,
          .belief_is_the_policys = !observer,
          .south_west = south_west,
          .baseline = baseline};
}

RecordedFlight open_recording(const fs::path& folder_or_journal, const RecordingOptions& options) {
  RecordedFlight flight;
  std::optional<FlightFiles> files;
  flight.journal_path = journal_of_flight(folder_or_journal);
  if (fs::exists(folder_or_journal / "summary.json")) files = read_flight_files(folder_or_journal);
  flight.journal = read_journal(flight.journal_path);
  require_decisions(flight.journal_path, flight.journal);
  flight.policy_path = options.policy ? *options.policy : file_beside(flight.journal_path, "policy");
  flight.policy = host::load_unverified_policy(flight.policy_path);
  const bool has_belief = policy::needs_belief(flight.policy->observation.spec);
  if (has_belief) {
    const fs::path tables = options.tables ? *options.tables : file_beside(flight.journal_path, "tables");
    flight.tables = host::tables_from(host::read_tables_bytes(tables), tables);
  }
  if (files) read_summary(folder_or_journal / "summary.json", files->summary, flight);
  if (!files) {
    if (const std::optional<SeaFlight> sea = read_sea_flight(flight.journal_path)) {
      flight.south_west = sea->area.south_west;
      flight.conditions = conditions_of(*sea);
    }
  }
  if (options.south_west) flight.south_west = *options.south_west;
  if (!has_belief) {
    if (!files || files->snr.empty())
      throw NothingToExplain(
          flight.policy_path.string() +
          ": holds no belief, and without the folder of a simulated flight (summary.json, snr.csv) there is no ocean to make one of");
    Observer observer = observer_of(*flight.policy, files->snr);
    flight.observer = observer.belief;
    flight.tables = std::move(observer.tables);
  }
  check_against_policy(flight);
  return flight;
}

std::size_t index_of_step(const RecordedFlight& flight, std::uint32_t step) {
  const std::size_t last = flight.journal.decisions.size() - 1;
  if (step <= last) return step;
  throw BadInput("--step " + std::to_string(step) + ": " + flight.journal_path.string() + " ends with the decision of step " +
                 std::to_string(last) + how_it_ends(flight.journal));
}

}  // namespace earshot::report
