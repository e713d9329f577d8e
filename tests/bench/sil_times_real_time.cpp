// sil.times_real_time: seconds at sea per second of wall clock, for a mission of 100 steps (50 000 s) with 1 Hz navigation, flown by both
// processes over real LCM and DDS, journal, track and all. The policy walks at random and a reached source does not end the mission, so
// that every run is as long; one that ends otherwise is none. With the argument "busy", sil.busy.times_real_time: the same beside eight
// busy loops on two processors.

#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/bench/busy_loops.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

void replace(std::string& text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("fixed_source.toml has no " + what);
  text.replace(at, what.size(), with);
}

/// The paper's search for so many steps. Wrong: its time is over before.
fs::path write_mission(const fs::path& folder, int steps) {
  std::string text = support::read_text(fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/fixed_source.toml");
  replace(text, "max_steps = 100", "max_steps = " + std::to_string(steps));
  if (bench::is_wrong_on_purpose()) replace(text, "max_time_s = 60000.0", "max_time_s = 600.0");
  std::ofstream(folder / "mission.toml") << text;
  return folder / "mission.toml";
}

/// @throws std::runtime_error unless the vehicle searched to its last step
void require_whole(const nlohmann::json& summary, int steps) {
  const std::string reason = summary.at("end_reason");
  if (reason != "steps_used_up" || summary.at("steps") != steps)
    throw std::runtime_error("the flight was to take " + std::to_string(steps) + " steps, and ended after " + summary.at("steps").dump() +
                             ": " + reason);
}

}  // namespace

int main(int argc, char** argv) try {
  const bool is_busy = argc > 1 && std::string_view(argv[1]) == "busy";
  std::optional<bench::BusyLoops> others;
  if (is_busy) {
    bench::use_two_processors();
    others.emplace();
  }
  const int steps = bench::full_or_short(100, 10);
  const fs::path source = EARSHOT_SOURCE_DIR;
  const support::TemporaryFolder folder;
  support::write_bytes(folder / "walk.policy", support::signed_bytes(support::random_walk_policy()));
  support::write_public_key(folder / "walk.pub");
  support::Process flight(fs::path(EARSHOT_BIN_DIR) / "earshot-fly",
                          {"--environment", source / "sim/ocean/environments/munk_flat.toml", "--mission",
                           write_mission(folder.path(), steps), "--policy", folder / "walk.policy", "--public-key", folder / "walk.pub",
                           "--seed", "1", "--out", folder / "flight", "--ignore-source", "--no-report"},
                          folder / "output.txt");
  const int status = flight.wait(std::chrono::minutes(5));
  if (status != 0) throw std::runtime_error(flight.output() + "earshot-fly: status " + std::to_string(status));
  const nlohmann::json summary = nlohmann::json::parse(support::read_text(folder / "flight/summary.json"));
  require_whole(summary, steps);
  const double value = summary.at("sim_time_s").get<double>() / summary.at("wall_time_s").get<double>();
  std::cout << nlohmann::ordered_json{{"name", is_busy ? "sil.busy.times_real_time" : "sil.times_real_time"},
                                      {"unit", "x"},
                                      {"steps", summary.at("steps")},
                                      {"value", value}}
            << "\n";
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
