// earshot bench: missions with the real earshotd on a CAN bus, each with faults.

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/bench/results.hpp"
#include "hil/bench/verdict.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> cases;
  std::optional<fs::path> folder;
  std::string interface = "vcan0";
  std::uint64_t seed = 1;
  fs::path out = "out/bench";
  std::optional<std::string> earshotd;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--case", &o.cases, "names of cases to fly, comma between them; default: all").separated_by(',');
  line.option("--cases", &o.folder, "folder of the cases; default: those that ship");
  line.option("--interface", &o.interface, "CAN interface").shows_default();
  line.option("--seed", &o.seed, "draws which frames a fault befalls").from(0, std::numeric_limits<std::int64_t>::max()).shows_default();
  line.option("--out", &o.out, "folder for results.json and a folder for every case").shows_default();
  line.option("--earshotd", &o.earshotd, "the earshotd to be tried; default: the one beside this program");
}

std::vector<hil::Case> chosen_cases(const Options& o) {
  const fs::path folder = o.folder ? *o.folder : host::shipped("hil/cases");
  if (!fs::is_directory(folder)) throw host::BadInput(host::printable(folder.string()) + ": no such folder");
  if (o.cases.empty()) return hil::load_cases(folder);
  std::vector<hil::Case> cases;
  for (const std::string& name : o.cases) {
    const fs::path file = folder / (name + ".toml");
    if (!fs::exists(file)) throw host::BadInput("--case " + host::printable(name) + ": there is no " + host::printable(file.string()));
    cases.push_back(hil::load_case(file));
  }
  return cases;
}

int bench(const Options& o) {
  const std::vector<hil::Case> cases = chosen_cases(o);
  const ocean::Environment environment = ocean::load_environment(host::shipped("sim/ocean/environments/munk_flat.toml"));
  constexpr Meters kFurthest{40'000.0};
  program::stop_on_signals();
  const hil::Bench setup{.earshotd = o.earshotd.value_or("earshotd"),
                         .interface = o.interface,
                         .seed = o.seed,
                         .snr = [curve = sonar::compute_snr_curve(environment, Meters{300.0}, kFurthest)](Meters range) { return curve.at(range); },
                         .floor_depth = environment.seabed.depth,
                         .stop = program::stop_requested};
  hil::Results results;
  for (const hil::Case& c : cases) {
    if (program::stop_requested) break;
    const fs::path folder = o.out / c.name;
    const hil::BenchFlight flight = hil::fly_case(c, setup, folder);
    const config::Mission mission = host::load_mission(c.mission).mission;
    const hil::JournalFindings journal = hil::read_findings(folder / "journal.lcmlog", mission);
    const std::vector<std::string> wrong = hil::faults_of(c, mission, flight, journal);
    program::say() << (wrong.empty() ? "passed " : "FAILED ") << c.name << ", " << flight.last.us / 1'000'000 << " s at sea in " << flight.wall_s << " s\n";
    for (const std::string& what : wrong) program::say() << "       " << what << "\n";
    program::say() << std::flush;
    results.add(c, mission, flight, journal, wrong);
  }
  host::write_whole(o.out / "results.json", results.text());
  program::say() << results.passed() << " of " << cases.size() << " cases passed\n";
  if (program::stop_requested) return program::kStopped;
  return results.passed() == cases.size() ? program::kDone : program::kIncomplete;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot bench",
                            "Flies missions with the real earshotd on a CAN bus, each with the faults of its case, and judges what came of\n"
                            "them. hil/run builds it, finds it a bus, and makes a page of its results.\n"
                            "Exit status: 0 every case passed; 1 one did not; 2 bad input; 3 the bus was lost.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return bench(options); });
}
