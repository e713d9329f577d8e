#include "firmware/boards/linux/outage/safety_log.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/boards/linux/outage/safety_places.hpp"
#include "firmware/host/safety_record/record_file.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;
using messages::MissionState;
using std::chrono::milliseconds;

constexpr milliseconds kPatient{10'000};
constexpr Time kUtc{1'795'000'000'000'000};

class SetHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return kUtc + running; }
  [[nodiscard]] Duration since_boot() const override { return running; }
  [[nodiscard]] BootId boot() const override { return {7}; }
  Duration running = Duration::seconds(100);
};

class SafetyLogTest : public testing::Test {
 protected:
  [[nodiscard]] host::SafetyRecord on_disk() const {
    host::RecordFile file(path_);
    return file.open() ? file.newest().value_or(host::SafetyRecord{}) : host::SafetyRecord{};
  }
  static runtime::Outputs outputs(std::uint64_t turn, MissionState state, bool commands = true) {
    runtime::Outputs outputs;
    outputs.health.turn = turn;
    outputs.health.state = state;
    if (commands) outputs.setpoint.emplace();
    return outputs;
  }
  [[nodiscard]] messages::Navigation fix(double depth_m) const {
    messages::Navigation fix;
    fix.time = kUtc + host_.running;
    fix.depth = Meters{depth_m};
    return fix;
  }
  bool note(const runtime::Outputs& outputs) { return log_.note(kUtc + host_.running, outputs, mission_, kPatient); }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "record";
  SetHost host_;
  config::Mission mission_ = runtime::paper_mission();
  host::SafetyCopies copies_{{{.file = path_}}};
  SafetyLog log_{copies_, host_, {}};
};

TEST_F(SafetyLogTest, HoldsTheNewStandingBeforeItReturns) {
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, std::vector<std::uint8_t>{1, 2}, kPatient));
  EXPECT_EQ(on_disk().journal_crc32, 77U);
  EXPECT_EQ(on_disk().max_depth, mission_.max_depth);
  EXPECT_FALSE(host::is_under_way(on_disk()));
  EXPECT_TRUE(note(outputs(1, MissionState::kSearch)));
  EXPECT_TRUE(on_disk().is_engaged);
  EXPECT_EQ(on_disk().state, MissionState::kSearch);
  EXPECT_EQ(on_disk().boot, BootId{7});
  EXPECT_EQ(on_disk().since_boot, host_.running);
  EXPECT_EQ(on_disk().mission_time, kUtc + host_.running);
  runtime::Outputs paused = outputs(2, MissionState::kSearch);
  paused.health.is_paused = true;
  EXPECT_TRUE(note(paused));
  EXPECT_TRUE(on_disk().is_paused);
  mission_.max_depth = Meters{100};
  EXPECT_TRUE(note(outputs(3, MissionState::kSearch)));
  EXPECT_EQ(on_disk().max_depth, Meters{100});
  EXPECT_EQ(on_disk().deepest, Meters{320}) << "it may be there still";
  runtime::Outputs released = outputs(4, MissionState::kAbort);
  released.setpoint->release_weight = true;
  EXPECT_TRUE(note(released));
  EXPECT_TRUE(on_disk().is_released);
  EXPECT_TRUE(note(outputs(5, MissionState::kAbort, false)));
  EXPECT_TRUE(on_disk().is_released && on_disk().is_engaged) << "what was released or commanded stays so";
  EXPECT_TRUE(log_.close(kPatient));
  EXPECT_FALSE(host::is_under_way(on_disk()));
}

TEST_F(SafetyLogTest, OfATurnThatChangesNothingWritesNothingButItsClocksEveryTenSeconds) {
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, {}, kPatient));
  ASSERT_TRUE(note(outputs(1, MissionState::kSearch)));
  const std::uint64_t sequence = on_disk().sequence;
  host_.running = host_.running + Duration::seconds(9);
  ASSERT_TRUE(note(outputs(2, MissionState::kSearch)));
  EXPECT_EQ(on_disk().sequence, sequence);
  host_.running = host_.running + Duration::seconds(1);
  ASSERT_TRUE(note(outputs(3, MissionState::kSearch)));
  for (int i = 0; i < 1000 && on_disk().sequence == sequence; ++i) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_EQ(on_disk().sequence, sequence + 1);
  EXPECT_EQ(on_disk().since_boot, host_.running);
}

TEST_F(SafetyLogTest, ForgetsItsStartsOnceItHasFlownForAMinute) {
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, {}, kPatient));
  host::SafetyRecord again = log_.record();
  again.starts = 2;
  SafetyLog log(copies_, host_, again);
  (void)log.note(kUtc, outputs(1, MissionState::kSearch), mission_, kPatient);
  EXPECT_EQ(on_disk().starts, 2U);
  host_.running = host_.running + Duration::seconds(61);
  (void)log.note(kUtc, outputs(2, MissionState::kAbort), mission_, kPatient);
  EXPECT_EQ(on_disk().starts, 0U);
}

TEST_F(SafetyLogTest, AFlightThatIsStoppedBelowStaysUnderWayUntilDepthAndTimeSayThatItIsUp) {
  mission_.safety.vehicle.ascent_rate = MetersPerSecond{0.5};
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, {}, kPatient));
  const auto sail = [&](double to_depth, double at_depth, int seconds) {
    for (int s = 0; s < seconds; ++s) {
      host_.running = host_.running + Duration::seconds(1);
      log_.hear(fix(at_depth));
      runtime::Outputs told = outputs(1, MissionState::kSearch);
      told.setpoint->depth = Meters{to_depth};
      told.setpoint->speed = MetersPerSecond{1};
      (void)note(told);
    }
  };
  sail(300, 300, 200);
  sail(0, 0, 5);  // a depth that says so at once
  EXPECT_FALSE(log_.close(kPatient));
  EXPECT_TRUE(host::is_under_way(on_disk()));
  sail(0, 0, 710);
  EXPECT_TRUE(log_.close(kPatient)) << "a minute, and 325 m at 0.5 m/s";
  EXPECT_FALSE(host::is_under_way(on_disk()));
}

TEST_F(SafetyLogTest, OfAFlightThatGoesOnAVehicleMayBeAsDeepAsItEverWas) {
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, {}, kPatient));
  ASSERT_TRUE(note(outputs(1, MissionState::kSearch)));
  host::SafetyRecord before = log_.record();
  before.deepest = Meters{300};
  SafetyLog again(copies_, host_, before);
  again.hear(fix(0));
  (void)again.note(kUtc + host_.running, outputs(2, MissionState::kAbort), mission_, kPatient);
  EXPECT_FALSE(again.close(kPatient)) << "a depth of 0 m may be wrong";
  EXPECT_TRUE(again.close(kPatient, true));
}

TEST_F(SafetyLogTest, AReleaseBeforeTheFirstTurnIsDurableAndStampsGoOn) {
  ASSERT_TRUE(log_.begin(kUtc, mission_, 77, {}, kPatient));
  EXPECT_TRUE(log_.release(kPatient));
  EXPECT_TRUE(on_disk().is_released);
  const std::uint64_t sequence = on_disk().sequence;
  host_.running = host_.running + Duration::seconds(9);
  log_.stamp(kUtc + host_.running);
  host_.running = host_.running + Duration::seconds(1);
  log_.stamp(kUtc + host_.running);
  for (int i = 0; i < 1000 && on_disk().sequence == sequence; ++i) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_EQ(on_disk().sequence, sequence + 1);
  EXPECT_EQ(on_disk().mission_time, kUtc + host_.running);
}

bool is_under_dev(const fs::path& folder) {
  return folder.string().starts_with("/dev/");
}

TEST(SafetyPlaces, AreTwoBesideTheJournalWhereNoneIsElsewhereOnADisk) {
  const auto places = safety_places("/a/search", {}, {.state = {}, .runtime = "/run/earshot"}, &is_under_dev);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].file, "/a/search/journal.safety");
  EXPECT_EQ(places[1].file, "/a/search/journal.copy.safety");
  EXPECT_TRUE(places[1].survives_power_cut);
  EXPECT_FALSE(places[2].survives_power_cut);
}

TEST(RecordOwner, IsThisComputerAndTheFolderOfTheFlights) {
  const support::TemporaryFolder folder;
  const ComputerFiles files{.machine_id = folder / "id", .transient_machine_id = folder / "run", .serial_number = folder / "serial"};
  const auto put = [](const fs::path& path, const char* text) { std::ofstream(path) << text << "\n"; };
  EXPECT_EQ(record_owner("/a/search", files).computer, 0U) << "nothing is told";
  put(files.machine_id, "0123456789abcdef");
  const host::RecordOwner one = record_owner("/a/search", files);
  EXPECT_NE(one.computer, 0U);
  EXPECT_EQ(one, record_owner("/a/search/", files));
  EXPECT_NE(one.folder, record_owner("/b/search", files).folder);
  put(files.serial_number, "1000000012345678");
  EXPECT_NE(one.computer, record_owner("/a/search", files).computer) << "a card of one computer in another";
  fs::remove(files.serial_number);
  put(files.machine_id, "uninitialized");
  EXPECT_EQ(record_owner("/a/search", files).computer, 0U);
  put(files.machine_id, "0123456789abcdef");
  put(files.transient_machine_id, "0123456789abcdef");
  EXPECT_EQ(record_owner("/a/search", files).computer, 0U) << "the next start of the computer has another";
}

TEST(SafetyPlaces, AreBesideTheJournalInTheServicesStateAndInMemory) {
  const auto places = safety_places("/var/lib/earshot/search", {}, {.state = "/var/lib/earshot", .runtime = "/run/earshot"}, &is_under_dev);
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[0].file, "/var/lib/earshot/search/journal.safety");
  EXPECT_EQ(places[1].file.parent_path(), "/var/lib/earshot");
  EXPECT_EQ(places[2].file, fs::path("/run/earshot") / places[1].file.filename());
  EXPECT_TRUE(places[0].survives_power_cut && places[1].survives_power_cut);
  EXPECT_FALSE(places[2].survives_power_cut);
}

TEST(SafetyPlaces, AreWhereAPersonSaysAndDifferForFoldersOfOneName) {
  const auto here = safety_places("/a/search/", {"/mnt/card", "/mnt/other"}, {.state = "/var/lib/earshot", .runtime = {}});
  const auto there = safety_places("/b/search", {"/mnt/card"}, {});
  ASSERT_EQ(here.size(), 3U);
  EXPECT_EQ(here[0].file, "/a/search/journal.safety");
  EXPECT_EQ(here[1].file.parent_path(), "/mnt/card");
  EXPECT_EQ(here[2].file.parent_path(), "/mnt/other");
  EXPECT_TRUE(here[1].file.filename().string().starts_with("search-"));
  EXPECT_NE(here[1].file, there[1].file);
}

TEST(SafetyPlaces, InMemoryAloneAreNoDiskWhoeverAskedForThem) {
  const SafetyFolders folders{.state = "/dev/state", .runtime = "/run/earshot"};
  const auto places = safety_places("/a/search", {"/dev/shm", "/mnt/card"}, folders, &is_under_dev);
  ASSERT_EQ(places.size(), 4U);
  EXPECT_TRUE(places[0].survives_power_cut);
  EXPECT_FALSE(places[1].survives_power_cut);
  EXPECT_TRUE(places[2].survives_power_cut);
  const std::vector<std::string> warnings = warnings_about(places, folders);
  ASSERT_EQ(warnings.size(), 1U) << "of /run/earshot nobody expects more";
  EXPECT_NE(warnings[0].find(places[1].file.string() + ": it is in memory"), std::string::npos) << warnings[0];

  const auto none = safety_places("/dev/shm/search", {}, folders, &is_under_dev);
  ASSERT_EQ(none.size(), 3U);
  const std::vector<std::string> all = warnings_about(none, folders);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NE(all[2].find("OBEYED_NOT_DURABLE"), std::string::npos) << all[2];
  EXPECT_TRUE(warnings_about(safety_places("/a/search", {}, folders, [](const fs::path&) { return false; }), folders).empty());
}

}  // namespace
}  // namespace earshot::board
