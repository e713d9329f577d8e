#include "tests/policy/report/flight_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "firmware/host/journal/journal.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::report {
namespace {

nlohmann::json place(NorthEast p) {
  return {{"north_m", p.north.value}, {"east_m", p.east.value}};
}

nlohmann::json summary_of(const policy::FrozenPolicy& policy, std::size_t steps, NorthEast corner) {
  return {{"found", false},
          {"reward", -3.0},
          {"steps", steps},
          {"distance_m", 1e3 * static_cast<double>(steps)},
          {"detections", 1},
          {"sim_time_s", 2e3},
          {"wall_time_s", 0.5},
          {"seed", 1},
          {"end_reason", "a test"},
          {"environment", "a"},
          {"mission", "b"},
          {"detection_threshold_db", policy.detection_threshold.value},
          {"source", place(corner + NorthEast{Meters{12'000.0}, Meters{15'000.0}})},
          {"start", place(corner + NorthEast{Meters{8'000.0}, Meters{6'000.0}})},
          {"area", {{"south_west", place(corner)}, {"north_east", place(corner + policy.area_size)}}}};
}

}  // namespace

void write_journal(const std::filesystem::path& path, const std::vector<explain::RecordedDecision>& decisions) {
  host::Journal journal(path, {.existing = host::ExistingJournal::kReplace});
  for (const explain::RecordedDecision& d : decisions) {
    const wire::Encoded encoded(static_cast<const messages::Decision&>(d));
    if (journal.append(d.time, wire::kDecisionChannel, encoded.bytes()) != Status::kOk) std::abort();
  }
  journal.conclude({});
  if (journal.close() != Status::kOk) std::abort();
}

void write_flight(const std::filesystem::path& folder, const policy::FrozenPolicy& policy,
                  const std::vector<explain::RecordedDecision>& decisions, NorthEast south_west) {
  std::filesystem::create_directories(folder);
  write_journal(folder / "journal.lcmlog", decisions);
  support::write_bytes(folder / "journal.policy", support::signed_bytes(policy));
  if (policy::needs_belief(policy.observation.spec))
    support::write_bytes(folder / "journal.tables", support::signed_bytes(explain::falling_ocean()));
  std::ofstream(folder / "summary.json") << summary_of(policy, decisions.size(), south_west);
  std::ofstream snr(folder / "snr.csv");
  snr << "range_m,snr_db\n";
  for (int i = 0; i <= 36; ++i) snr << 1000 * i << ',' << 40 - i << '\n';
  std::ofstream track(folder / "track.csv");
  track << "time_s,north_m,east_m,depth_m,heading_deg,speed_mps,snr_db,range_m,state,steps_taken\n";
  for (const explain::RecordedDecision& d : decisions)
    track << d.time_s() << ',' << d.position.north.value << ',' << d.position.east.value << ",300,0,2," << d.snr.value << ",9000,search,"
          << d.step << '\n';
}

}  // namespace earshot::report
