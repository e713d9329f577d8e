#include "hil/bench/flight/fly_case.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/program/exit_status.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

namespace fs = std::filesystem;

/// Flies a case over LCM with a script in the place of earshotd.
class BenchFlightTest : public testing::Test {
 protected:
  [[nodiscard]] BenchFlight fly(const std::string& script, const fs::path& folder) const {
    std::ofstream(earshotd_) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(earshotd_, fs::perms::owner_all);
    Case c;
    c.mission = fs::path(EARSHOT_SOURCE_DIR) / "hil/missions/search_over_lcm.toml";
    c.bus = host::PortKind::kLcm;
    c.at_most = Duration::seconds(10);
    const std::atomic<bool> stop{false};
    return fly_case(c, {.earshotd = earshotd_, .snr = [](Meters) { return Decibels{0.0}; }, .floor_depth = Meters{5000}, .stop = stop},
                    folder);
  }
  const support::TemporaryFolder folder_;
  const fs::path earshotd_ = folder_ / "earshotd";
  const fs::path out_ = folder_ / "out";
};

TEST_F(BenchFlightTest, DoesNotWaitForAnEarshotdThatHasEnded) {
  const BenchFlight flight = fly("echo garbage; exit 0", out_);
  EXPECT_TRUE(support::tells(flight.failure, {"earshotd", "not answer", "simulator's"}));
  EXPECT_EQ(flight.exit_statuses, std::vector{program::kDone});
  EXPECT_LT(flight.wall_s, 10.0) << "20 s are for one that is there";
}

TEST_F(BenchFlightTest, SaysWhyItCannotBeFlownAtAll) {
  std::ofstream{out_} << "a file";
  const BenchFlight flight = fly("exit 0", out_ / "calm");
  EXPECT_NE(flight.failure.find("Not a directory"), std::string::npos) << flight.failure;
}

TEST_F(BenchFlightTest, RemovesAnEarlierFlightAndNothingElse) {
  fs::create_directories(out_);
  const auto is_left = [&](const char* name) { return fs::exists(out_ / name); };
  for (const char* const name : {"journal.lcmlog", "journal-2.part3.lcmlog", "journal.policy", "journal.safety", "journal.copy.safety",
                                 "journal_of_2025.txt", "journals"})
    std::ofstream(out_ / name) << "earlier";
  (void)fly("exit 0", out_);
  EXPECT_FALSE(is_left("journal.lcmlog") || is_left("journal-2.part3.lcmlog") || is_left("journal.policy"));
  EXPECT_FALSE(is_left("journal.safety") || is_left("journal.copy.safety"));
  EXPECT_TRUE(is_left("journal_of_2025.txt") && is_left("journals"));
}

}  // namespace
}  // namespace earshot::hil
