// earshot field --library as its users meet it: interrupted, on several ranks, with bad input, on a full disk.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "sim/netcdf/reader.hpp"
#include "tests/sim/apps/field/field_program.hpp"
#include "tests/sim/netcdf/kept_conventions.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"

namespace earshot::tests {
namespace {

class FieldLibrary : public FieldProgram {
 protected:
  FieldLibrary() { write_hilly_ocean(folder_); }

  /// side x side positions of 4 radials each.
  std::string library(int side, const std::string& change = "", const std::string& by = "") {
    std::string north;
    for (int i = 0; i < side; ++i) north += std::to_string(-4000 + 300 * i) + ", ";
    std::string text =
        "name = \"test\"\nenvironment = \"hilly.toml\"\nsource_depth_m = [30.0]\nreceiver_depth_m = [100.0, 300.0]\n[positions]\n"
        "layout = \"grid\"\nnorth_m = [" +
        north + "]\neast_m = [" + north +
        "]\n[radials]\ncount = 4\nmax_range_km = 8.0\n"
        "range_step_m = 100.0\n";
    if (!change.empty()) text.replace(text.find(change), change.size(), by);
    std::ofstream(folder_ / "library.toml") << text;
    return "--library " + (folder_ / "library.toml").string();
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / "out" / name).string(); }

  [[nodiscard]] pid_t start(const std::string& output) const {
    const pid_t child = fork();
    if (child == 0) {
      const std::string program = std::string(EARSHOT_BIN_DIR) + "/earshot-field";
      const std::string plan = (folder_ / "library.toml").string();
      execl(program.c_str(), program.c_str(), "--library", plan.c_str(), "-o", output.c_str(), nullptr);
      _exit(127);
    }
    return child;
  }

  /// Returns when a first position is marked done. @return 0 if it ended before that
  [[nodiscard]] pid_t start_until_first_mark(const std::string& output) const {
    const pid_t child = start(output);
    while (done(output + ".partial") == 0) {
      if (waitpid(child, nullptr, WNOHANG) != 0) return 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return child;
  }
  static void kill_and_wait(pid_t child) {
    ASSERT_GT(child, 0) << "it ended too early to be killed";
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }

  /// Positions marked done, by what is on the disk.
  [[nodiscard]] static int done(const std::string& partial) {
    if (!std::filesystem::exists(partial)) return 0;
    const auto state = netcdf::Reader(partial).read("position_state");
    return static_cast<int>(std::count(state.begin(), state.end(), 1.0));
  }
};

TEST_F(FieldLibrary, IsNeverWrittenOverAFileThatIsReadForIt) {
  const std::string plan = library(1);
  std::filesystem::create_hard_link(folder_ / "chart.csv", folder_ / "hard.nc");
  for (const char* name : {"library.toml", "hilly.toml", "chart.csv", "hard.nc"}) {
    const std::string before = read(folder_ / name);
    expect_refused(plan + " --force -o " + (folder_ / name).string(), std::string(name) + ": the same file, one would replace the other");
    EXPECT_EQ(read(folder_ / name), before);
  }
}

TEST_F(FieldLibrary, EndsWithTheSameBytesWhenKilledInTheMiddleAndStartedAgain) {
  const std::string plan = library(10);
  ASSERT_EQ(run(plan + " -o " + file("whole.nc")), 0) << errors();

  const pid_t child = start_until_first_mark(file("killed.nc"));
  kill_and_wait(child);
  ASSERT_FALSE(std::filesystem::exists(file("killed.nc"))) << "half a library stands under the name of a whole one";
  const int kept = done(file("killed.nc.partial"));
  ASSERT_GT(kept, 0);

  ASSERT_EQ(run(plan + " -o " + file("killed.nc")), 0) << errors();
  EXPECT_NE(said().find(std::to_string(kept) + " found from before"), std::string::npos) << said();
  EXPECT_EQ(read(file("killed.nc")), read(file("whole.nc")));
  EXPECT_FALSE(std::filesystem::exists(file("killed.nc.partial")));
}

TEST_F(FieldLibrary, HasTheSameBytesForEveryNumberOfThreads) {
  const std::string plan = library(3);
  ASSERT_EQ(run(plan + " -o " + file("one.nc") + " --threads 1"), 0) << errors();
  ASSERT_EQ(run(plan + " -o " + file("five.nc") + " --threads 5"), 0) << errors();
  EXPECT_EQ(read(file("one.nc")), read(file("five.nc")));
}

TEST_F(FieldLibrary, HasTheSameBytesFromTwoMpiRanks) {
  if (std::string(EARSHOT_MPIEXEC).empty()) GTEST_SKIP() << "built without MPI";
  const std::string plan = library(3);
  ASSERT_EQ(run(plan + " -o " + file("one.nc")), 0) << errors();
  // Named as root runs it in containers; --oversubscribe where there is one core.
  const std::string launcher = std::string(EARSHOT_MPIEXEC) + " --allow-run-as-root --oversubscribe -n 2";
  ASSERT_EQ(run(plan + " -o " + file("two.nc"), launcher), 0) << errors();
  EXPECT_NE(said().find("2 processes"), std::string::npos) << said();
  EXPECT_EQ(read(file("one.nc")), read(file("two.nc")));
  EXPECT_EQ(run(library(3, "count = 4", "count = -4") + " -o " + file("bad.nc"), launcher), 2);
  EXPECT_NE(errors().find("radials.count = -4"), std::string::npos) << errors();
}

TEST_F(FieldLibrary, MarksPositionsOnLandAndComputesTheOthers) {
  // The island: (0 north, 7000 east).
  ASSERT_EQ(run(library(1, "north_m = [-4000, ]\neast_m = [-4000, ]", "north_m = [0]\neast_m = [-4000, 7000]") + " -o " + output()), 0)
      << errors();
  EXPECT_NE(said().find("1 computed, 1 on land or too shallow"), std::string::npos) << said();
  expect_kept_conventions(output());
  EXPECT_EQ(netcdf::Reader(output()).read("position_state"), (std::vector<double>{1.0, 2.0}));
  std::filesystem::remove(output());
  expect_refused(library(1, "north_m = [-4000, ]\neast_m = [-4000, ]", "north_m = [0]\neast_m = [7000]") + " -o " + output(), "on land");
}

TEST_F(FieldLibrary, DoesNotTakeUpWhatWasBegunForAnotherLibrary) {
  (void)library(16);
  const pid_t child = start_until_first_mark(output());
  EXPECT_EQ(run(library(16) + " -o " + output()), 2);
  EXPECT_NE(errors().find("another process is writing it"), std::string::npos) << errors();
  kill_and_wait(child);
  EXPECT_EQ(run(library(16, "count = 4", "count = 5") + " -o " + output()), 2);
  EXPECT_NE(errors().find("begun with another"), std::string::npos) << errors();
}

TEST_F(FieldLibrary, SaysThatTheDiskIsTooSmallBeforeTheWork) {
  const std::string plan = library(16);  // 256 x 4 x 80 x 2 floats: 655 KB
  EXPECT_EQ(run(plan + " -o " + output(), "ulimit -f 200; trap '' XFSZ;"), 2);
  EXPECT_NE(errors().find("cannot be written"), std::string::npos) << errors();
  EXPECT_TRUE(nothing_written());
}

TEST_F(FieldLibrary, RefusesAPartialFileThatIsTruncated) {
  (void)library(16);
  const pid_t child = start_until_first_mark(output());
  kill_and_wait(child);
  std::filesystem::resize_file(output() + ".partial", 100'000);
  EXPECT_EQ(run(library(16) + " -o " + output()), 2);
  EXPECT_NE(errors().find("truncated"), std::string::npos) << errors();
}

TEST_F(FieldLibrary, RefusesABadPlanNamingFileKeyAndRange) {
  expect_refused(library(2, "count = 4", "count = 0") + " -o " + output(), "radials.count = 0");
  expect_refused(library(2, "range_step_m", "range_step") + " -o " + output(), "radials.range_step: unknown key");
  expect_refused(library(2, "[30.0]", "[30.0, 40.0]") + " -o " + output(), "must be one depth");
  expect_refused(library(2, "[100.0, 300.0]", "[300.0, 100.0]") + " -o " + output(), "increasing");
  expect_refused(library(2, "hilly.toml", "none.toml") + " -o " + output(), "none.toml: no such file");
  expect_refused(library(2, "max_range_km = 8.0", "max_range_km = 80.0") + " -o " + output(), "chart.csv");
  expect_refused("--library /nowhere.toml -o " + output(), "/nowhere.toml: no such file");
}

}  // namespace
}  // namespace earshot::tests
