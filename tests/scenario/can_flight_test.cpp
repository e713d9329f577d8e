// One mission over CAN, held against the same mission over LCM. Runs where vcan0 is (hil/bus/with-can).

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct Row {
  double time_s, north_m, east_m, depth_m;
  unsigned steps;
};

std::vector<Row> read_track(const fs::path& path) {
  std::ifstream stream(path);
  std::vector<Row> rows;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    Row row{};
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%*f,%*f,%*f,%*f,%*[a-z],%u", &row.time_s, &row.north_m, &row.east_m, &row.depth_m,
                    &row.steps) != 5) {
      ADD_FAILURE() << path << ": " << line;
    }
    rows.push_back(row);
  }
  return rows;
}

/// How two tracks of one mission part.
struct Parting {
  double before_first_flip_m = 0.0;  ///< largest distance while both were in the same step at every tick
  double after_m = 0.0;              ///< largest distance later
  unsigned flips = 0;                ///< steps that one of them ended at another tick
  unsigned longest_flip_ticks = 0;
};

/// Compares tick by tick and says where a rounding moved the end of a step to another tick.
Parting compare(const std::vector<Row>& lcm, const std::vector<Row>& can) {
  Parting parting;
  unsigned flipped_for = 0;
  for (std::size_t i = 0; i < std::min(lcm.size(), can.size()); ++i) {
    const double apart = std::hypot(lcm[i].north_m - can[i].north_m, lcm[i].east_m - can[i].east_m, lcm[i].depth_m - can[i].depth_m);
    const bool same_step = lcm[i].steps == can[i].steps;
    if (!same_step && flipped_for++ == 0) {
      ++parting.flips;
      std::cout << "a rounding moved the end of step " << std::min(lcm[i].steps, can[i].steps) << " at " << lcm[i].time_s << " s; tracks "
                << apart << " m apart\n";
    }
    if (same_step) flipped_for = 0;
    parting.longest_flip_ticks = std::max(parting.longest_flip_ticks, flipped_for);
    double& worst = parting.flips == 0 ? parting.before_first_flip_m : parting.after_m;
    worst = std::max(worst, apart);
  }
  return parting;
}

class CanFlight : public testing::Test {
 protected:
  void SetUp() override {
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(support::random_walk_policy()));
    support::write_public_key(folder_ / "walk.pub");
    std::string mission = support::read_text(fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/fixed_source.toml");
    const std::size_t at = mission.find("max_steps = 100");
    ASSERT_NE(at, std::string::npos);
    std::ofstream(folder_ / "short.toml") << mission.replace(at, 15, "max_steps = 4");
  }
  void TearDown() override {
    if (HasFailure()) folder_.keep();
  }

  void fly(const std::string& out, const std::string& bus) const {
    support::Process flight(fs::path(EARSHOT_BIN_DIR) / "earshot-fly",
                            {"--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub", "--mission", folder_ / "short.toml",
                             "--environment", fs::path(EARSHOT_SOURCE_DIR) / "sim/ocean/environments/munk_flat.toml", "--out",
                             folder_ / out, "--bus", bus, "--seed", "2", "--ignore-source", "--no-report"},
                            folder_ / (out + ".txt"));
    ASSERT_EQ(flight.wait(240s), 0) << flight.output();
  }

  support::TemporaryFolder folder_;
};

TEST_F(CanFlight, GivenOneSeedTwoFlightsOverCanGoTheSameWayByteForByte) {
  fly("first", "can");
  fly("second", "can");
  const std::string track = support::read_text(folder_ / "first/track.csv");
  EXPECT_GT(track.size(), 100'000);
  EXPECT_TRUE(track == support::read_text(folder_ / "second/track.csv"));
}

TEST_F(CanFlight, GivenNavigationOverCanAndTheRestOverLcmOneSeedGoesTheSameWayTwiceAndItsJournalGivesEveryByteAgain) {
  fly("first", "mixed");
  fly("second", "mixed");
  const std::string track = support::read_text(folder_ / "first/track.csv");
  EXPECT_GT(track.size(), 100'000);
  EXPECT_TRUE(track == support::read_text(folder_ / "second/track.csv"));
  const board::ReplayResult replayed = board::replay(folder_ / "first/journal.lcmlog");
  EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
  EXPECT_EQ(replayed.end, host::JournalReader::End::kWhole);
  EXPECT_EQ(replayed.decisions, 4);
}

TEST_F(CanFlight, GivenTheSameMissionOverLcmTheTracksPartByNoMoreThanTheFramesResolution) {
  fly("lcm", "lcm");
  fly("can", "can");
  const std::vector<Row> lcm = read_track(folder_ / "lcm/track.csv");
  const std::vector<Row> can = read_track(folder_ / "can/track.csv");
  ASSERT_GT(lcm.size(), 1700);
  const Parting parting = compare(lcm, can);
  // A position on the bus is a multiple of 1e-7 degree (11 mm); guidance steers by it, and the heading it asks for is a multiple of 1e-4
  // rad, over the 50 m or so in which a cross-track error is taken back 5 mm: 2 cm hold both.
  EXPECT_LT(parting.before_first_flip_m, 0.02);
  // A step ends at a tick, 2 m apart, so that a rounding moves its end by one tick and the rest of the track by 2 m at most, every time.
  EXPECT_LE(parting.longest_flip_ticks, 1 + parting.flips);
  EXPECT_LE(parting.after_m, 0.02 + 2.0 * 1.5 * parting.flips);
  std::cout << "before the first flip at most " << parting.before_first_flip_m << " m apart; " << parting.flips << " flips, then at most "
            << parting.after_m << " m\n";
}

}  // namespace
}  // namespace earshot
