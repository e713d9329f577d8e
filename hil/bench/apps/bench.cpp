// earshot bench: missions with the real earshotd on a CAN bus or over LCM, each with faults.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/text/numbers.hpp"
#include "hil/bench/before_flight.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/bench/disarmed.hpp"
#include "hil/bench/flight/fly_case.hpp"
#include "hil/bench/random_case.hpp"
#include "hil/bench/results.hpp"
#include "hil/bench/torn_journal.hpp"
#include "hil/bench/verdict.hpp"
#include "policy/report/page/page_template.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> cases;
  std::optional<fs::path> folder;
  std::optional<fs::path> mission;
  std::optional<fs::path> environment;
  std::string interface = "vcan0";
  std::uint64_t seed = 1;
  fs::path out = "out/bench";
  std::optional<std::string> earshotd;
  std::optional<std::uint32_t> random;
  bool disarmed = false;
  bool judge = false;
  bool page = false;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--case", &o.cases, "names of cases to fly, comma between them; default: all").separated_by(',');
  line.option("--cases", &o.folder, "folder of the cases; default: those that ship");
  line.option("--mission", &o.mission, "of the cases that name none; default: the one that ships");
  line.option("--environment", &o.environment, "ocean, source level and noise (TOML); default: munk_flat.toml");
  line.option("--interface", &o.interface, "CAN interface, for the cases over CAN").shows_default();
  line.option("--seed", &o.seed, "draws which frames a fault is injected into")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--out", &o.out, "folder for results.json and a folder for every case").shows_default();
  line.option("--random", &o.random,
              "fly so many random combinations of the cases' faults instead, which must break no promise; what fails is made smaller")
      .from(1, 1'000'000);
  line.flag("--disarmed", &o.disarmed, "fly the cases without the rules that must fire in them instead: each must fail");
  line.flag("--judge", &o.judge, "read the cases and their missions, and report what is wrong with one, but fly none");
  line.flag("--page", &o.page,
            "fly none, and put what hil/run knows of a run (JSON, on standard input) into a page (HTML, on standard output)");
  line.option("--earshotd", &o.earshotd, "the earshotd to be tried; default: the one beside this program");
}

std::vector<hil::Case> chosen_cases(const Options& o) {
  const fs::path folder = o.folder ? *o.folder : host::shipped("hil/cases");
  if (!fs::is_directory(folder)) throw host::BadInput(host::printable(folder.string()) + ": no such folder");
  const fs::path usual_mission = o.mission ? *o.mission : host::shipped("hil/missions/search_over_can.toml");
  if (o.cases.empty()) return hil::load_cases(folder, usual_mission);
  std::vector<hil::Case> cases;
  for (const std::string& name : o.cases) {
    const fs::path file = folder / (name + ".toml");
    if (!fs::exists(file)) throw host::BadInput("--case " + host::printable(name) + ": there is no " + host::printable(file.string()));
    cases.push_back(hil::load_case(file, usual_mission));
  }
  return cases;
}

/// Those of which one seed gives one flight.
std::vector<hil::Case> in_lock_step(std::vector<hil::Case> cases) {
  std::erase_if(cases, [](const hil::Case& c) { return c.speed.has_value(); });
  return cases;
}

/// A case and what came of it.
struct Flown {
  hil::BenchFlight flight;
  config::Mission mission;
  hil::JournalFindings journal;
};

Flown flown(const hil::Case& c, const hil::Bench& setup, const fs::path& folder) {
  Flown f{.flight = hil::fly_case(c, setup, folder), .mission = host::load_mission(c.mission).mission, .journal = {}};
  f.journal = hil::read_findings(host::newest_journal_in(folder), f.mission, f.flight.began);
  if (!f.flight.is_end_heard) f.flight.end = f.journal.end;
  return f;
}

/// What is wrong with it, in words.
std::vector<std::string> verdict(const hil::Case& c, const Flown& f) {
  if (!f.flight.not_flown.empty()) return {"not flown: " + f.flight.not_flown};
  std::vector<std::string> wrong = hil::broken_promises(c, f.mission, f.flight, f.journal);
  const std::vector<std::string> unmet = hil::unmet_expectations(c, f.flight, f.journal);
  wrong.insert(wrong.end(), unmet.begin(), unmet.end());
  return wrong;
}

void print_result(const hil::Case& c, const Flown& f, const std::vector<std::string>& wrong) {
  program::print() << (wrong.empty() ? "passed " : "FAILED ") << c.name << ", " << f.flight.last.us / 1'000'000 << " s at sea in "
                   << host::decimals(f.flight.wall_s, 1) << " s\n";
  for (const std::string& what : wrong) program::print() << "       " << what << "\n";
  program::print() << std::flush;
}

int fly_cases(const Options& o, const std::vector<hil::Case>& cases, const hil::Bench& setup) {
  using std::chrono::steady_clock;
  constexpr int kShare = 9;  // of the time, to one that goes into writing
  const fs::path file = hil::results_file(o.out);
  hil::Results results;
  steady_clock::time_point next_writing;
  for (const hil::Case& c : cases) {
    if (program::stop_requested) break;
    const Flown f = flown(c, setup, o.out / c.name);
    if (program::stop_requested) break;  // it was cut short, and nothing can be said of it
    const std::vector<std::string> wrong = verdict(c, f);
    print_result(c, f, wrong);
    results.add(c, f.mission, f.flight, f.journal, wrong);
    // Ctrl-C kills user-mode Linux, and this program in it: what was flown by then is on the disk.
    const steady_clock::time_point now = steady_clock::now();
    if (now < next_writing) continue;
    host::write_whole(file, results.text());
    const steady_clock::time_point written = steady_clock::now();
    next_writing = written + kShare * (written - now);
  }
  host::write_whole(file, results.text());
  program::print() << results.passed() << " of " << cases.size() << " cases passed\n";
  if (program::stop_requested) return program::kStopped;
  return results.passed() == cases.size() ? program::kDone : program::kIncomplete;
}

/// Whether the case passes, and fails without the rules that must fire in it: not because they do not fire then, but because what they do
/// is not done (expected_without_firing). It is flown no longer than kPutOff behind where it ends with them.
bool fails_without_its_rules(hil::Case c, const hil::Bench& setup, const fs::path& folder) {
  const Flown armed = flown(c, setup, folder);
  if (!armed.flight.failure.empty() || !hil::unmet_expectations(c, armed.flight, armed.journal).empty()) return false;
  const std::string text = host::read_text(c.mission, host::kTomlFile);
  host::write_whole(folder / "mission.toml", hil::disarmed(text, c.expected.rules, c.mission.parent_path()));
  c.mission = folder / "mission.toml";
  c.expected = hil::expected_without_firing(c.expected, c.expected.rules, armed.mission);
  c.at_most = armed.flight.last - Time{} + hil::kPutOff;
  const Flown without = flown(c, setup, folder);
  return without.flight.failure.empty() && !hil::unmet_expectations(c, without.flight, without.journal).empty();
}

/// Each case without the rules that must fire in it: who still passes does not test them.
int fly_disarmed(const Options& o, const std::vector<hil::Case>& cases, const hil::Bench& setup) {
  std::size_t flown_count = 0;
  std::size_t blind = 0;
  for (const hil::Case& c : cases) {
    if (program::stop_requested) break;
    if (std::ranges::none_of(c.expected.rules, hil::can_be_disarmed)) continue;
    const bool is_red = fails_without_its_rules(c, setup, o.out / "disarmed" / c.name);
    if (program::stop_requested) break;  // it was cut short
    program::print() << (is_red ? "fails as it must " : "BLIND ") << c.name << "\n" << std::flush;
    ++flown_count;
    if (!is_red) ++blind;
  }
  program::print() << flown_count << " cases without their rules, " << blind << " of them do not test them\n";
  if (program::stop_requested) return program::kStopped;
  return blind == 0 ? program::kDone : program::kIncomplete;
}

/// Each with a seed of its own, from --seed on. What breaks a promise is made smaller, and kept as a case.
int fly_random(const Options& o, const std::vector<hil::Case>& pool, const hil::Bench& setup) {
  std::size_t failed = 0;
  std::uint32_t count = 0;
  for (; count < *o.random; ++count) {
    const hil::Case c = hil::random_case(pool, o.seed + count);
    const auto wrong_with = [&](const hil::Case& tried, const fs::path& folder) {
      const Flown f = flown(tried, setup, folder);
      return hil::broken_promises(tried, f.mission, f.flight, f.journal);
    };
    const std::vector<std::string> wrong = wrong_with(c, o.out / "random");
    if (program::stop_requested) break;  // it was cut short
    if (wrong.empty()) continue;
    ++failed;
    program::print() << "FAILED " << c.name << ": " << c.when << "\n";
    for (const std::string& what : wrong) program::print() << "       " << what << "\n";
    const hil::Case small =
        hil::shrunk(c, [&](const hil::Case& tried) { return !wrong_with(tried, o.out / "shrunk").empty() && !program::stop_requested; });
    const fs::path kept = o.out / (c.name + ".toml");
    host::write_whole(kept, hil::to_toml(small));
    program::print() << "       " << small.faults.size() << " of its faults are enough, with --seed " << o.seed << ": " << kept.string()
                     << "\n"
                     << std::flush;
  }
  program::print() << count << " random cases from seed " << o.seed << " on, " << failed << " broke a promise\n";
  if (program::stop_requested) return program::kStopped;
  return failed == 0 ? program::kDone : program::kIncomplete;
}

/// Of a run that is over: policy/report/page/source/bench.ts.
int print_page() {
  const std::string json(std::istreambuf_iterator<char>(std::cin), {});
  program::print() << report::page_with(json, report::PageOf::kBench) << std::flush;
  return program::kDone;
}

int bench(const Options& o) {
  if (o.page) return print_page();
  const std::vector<hil::Case> cases = chosen_cases(o);
  if (o.judge) return program::kDone;
  hil::require_flyable(cases);
  const host::FileDescriptor folder = hil::take_folder(o.out);
  const std::optional<host::BusLock> bus = hil::take_bus(cases, o.interface);
  const fs::path ocean = o.environment ? *o.environment : host::shipped("sim/ocean/environments/munk_flat.toml");
  const ocean::Environment environment = ocean::load_environment(ocean);
  constexpr Meters kFurthest{40'000.0};
  constexpr Meters kDepth{300.0};
  program::stop_on_signals();
  program::stop_on_sighup();  // an interface that a case took down is not left so
  const hil::Bench setup{
      .earshotd = o.earshotd.value_or("earshotd"),
      .interface = o.interface,
      .seed = o.seed,
      .snr = [curve = sonar::compute_snr_curve(environment, kDepth, kFurthest)](Meters range) { return curve.at(range); },
      .floor_depth = environment.seabed.depth,
      .environment = ocean,
      .stop = program::stop_requested};
  if (o.disarmed) return fly_disarmed(o, in_lock_step(cases), setup);
  return o.random ? fly_random(o, in_lock_step(cases), setup) : fly_cases(o, cases, setup);
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot bench",
      "Flies missions with the real earshotd on a CAN bus or over LCM, each with the faults of its case, and judges what came of\n"
      "them. hil/run builds it, finds it a bus, and makes a page of its results.\n"
      "Exit status: 0 every case passed; 1 one did not; 2 bad input; 3 what was to be printed could not be; 130 stopped by a signal.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return bench(options); });
}
