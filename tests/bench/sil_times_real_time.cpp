// sil.times_real_time: seconds at sea per second of wall clock, for a mission of 100 steps (50 000 s) with 1 Hz navigation, flown by both
// processes over real LCM and DDS, journal, track and all. The policy walks at random and a reached source does not end the mission, so
// that every run is as long. With the argument "busy", sil.busy.times_real_time: the same beside eight busy loops on two processors.

#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "tests/bench/busy_loops.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  namespace fs = std::filesystem;
  const bool is_busy = argc > 1 && std::string_view(argv[1]) == "busy";
  std::optional<bench::BusyLoops> others;
  if (is_busy) {
    bench::use_two_processors();
    others.emplace();
  }
  const fs::path source = EARSHOT_SOURCE_DIR;
  const support::TemporaryFolder folder;
  support::write_bytes(folder / "walk.policy", support::signed_bytes(support::random_walk_policy()));
  support::write_public_key(folder / "walk.pub");
  support::Process flight(fs::path(EARSHOT_BIN_DIR) / "earshot-fly",
                          {"--environment", source / "sim/ocean/environments/munk_flat.toml", "--mission",
                           source / "firmware/boards/linux/missions/fixed_source.toml", "--policy", folder / "walk.policy", "--public-key",
                           folder / "walk.pub", "--seed", "1", "--out", folder.path(), "--ignore-source", "--no-report"},
                          folder / "output.txt");
  const int status = flight.wait(std::chrono::minutes(5));
  if (status != 0) {
    std::cerr << flight.output();
    return 1;
  }
  const nlohmann::json summary = nlohmann::json::parse(support::read_text(folder / "summary.json"));
  const double value = summary.at("sim_time_s").get<double>() / summary.at("wall_time_s").get<double>();
  std::cout << nlohmann::ordered_json{{"name", is_busy ? "sil.busy.times_real_time" : "sil.times_real_time"},
                                      {"unit", "x"},
                                      {"steps", summary.at("steps")},
                                      {"value", value}}
            << "\n";
}
