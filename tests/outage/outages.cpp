// Vehicles at sea whose earshotd is killed in mid-mission and started again while something is wrong: the disk, a clock, a file, a bit,
// another owner of the bus, two of them at once. Whatever it is, within ten seconds of the start somebody commands the vehicle: it goes on,
// or comes up; and what was acknowledged holds. How many: EARSHOT_OUTAGES, 2,000 in tests/outage/run; from which on: EARSHOT_OUTAGES_FROM.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/safety_record/record_file.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"

namespace earshot {
namespace {

namespace fs = std::filesystem;
using messages::CommandOutcome;
using messages::MissionState;
using messages::Order;
using std::chrono::steady_clock;

/// What had been done when it was killed.
enum class Before { kSearched, kPaused, kTightened, kAborted, kReleased };
constexpr int kBefores = 5;

/// What is wrong from then on.
enum class Wrong {
  kNothing,
  kFullDisk,
  kReadOnlyDisk,
  kSlowDisk,
  kClockBehind,
  kClockAhead,
  kComputerStartedAgain,
  kNoRealTimeClock,
  kBitInJournal,
  kBitInRecord,
  kNoJournal,
  kNoRecord,
  kNoMission,
  kNoPolicy,
  kNoKey,
  kSecondOwner,
  kSilentSensors,
  kFewFiles,
  kFewThreads,
  kOptionsInConflict,
  kStaleCopy,
  kOthersRecord,
  kHolderThatHangs,
  kRecordsRemovedInFlight,
  kStoppedInOrder,
};
constexpr int kWrongs = 25;
constexpr const char* kWords[]{"nothing",
                               "a full disk",
                               "a read-only disk",
                               "a slow disk",
                               "a clock behind",
                               "a clock ahead",
                               "another start",
                               "no clock",
                               "a bit in the journal",
                               "a bit in a record",
                               "no journal",
                               "no record",
                               "no mission",
                               "no policy",
                               "no key",
                               "a second owner",
                               "silent sensors",
                               "few files",
                               "few threads",
                               "options in conflict",
                               "a stale copy",
                               "another vehicle's record",
                               "a holder that hangs",
                               "records removed in flight",
                               "a stop in order"};
/// Options that no mission at sea may have, or not with --resume.
const std::vector<std::string> kConflicts[]{
    {"--replace"}, {"--chart", "chart.svg"}, {"--journal-part-mb", "100", "--journal-budget-mb", "150"}};
/// Of which the standard streams have three.
constexpr int kFewFiles = 20;

int number_in(const char* variable, int otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

class Outages : public WalkAtSea, public testing::WithParamInterface<int> {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    vehicle_.emplace(std::string(host::kDefaultLcmUrl));
    std::string mission = patient(mission_of_short_steps("search.toml"));
    replace(mission, "speed_mps = 20.0", "speed_mps = 2.0");  // the rule that wants progress waits for seconds
    write_mission(mission + "\n[[rule]]\nwhen = \"leak\"\nfor_s = 1.0\nthen = \"release\"\n");
    for (const char* name : {"state", "memory"}) fs::create_directory(folder_ / name);
    before_ = static_cast<Before>(below(kBefores));
    wrongs_ = {static_cast<Wrong>(below(kWrongs)), below(2) == 0 ? Wrong::kNothing : static_cast<Wrong>(below(kWrongs))};
    has_memory_ = below(2) == 0;
  }

  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_.uniform_double() * bound); }
  [[nodiscard]] bool is(Wrong wrong) const { return wrongs_[0] == wrong || wrongs_[1] == wrong; }
  [[nodiscard]] std::string sickness() const {
    if (is(Wrong::kReadOnlyDisk)) return "read-only";
    if (is(Wrong::kFullDisk)) return "crammed";
    return is(Wrong::kSlowDisk) ? "slow" : "";
  }
  [[nodiscard]] bool is_in_new_boot() const { return is(Wrong::kComputerStartedAgain) || is(Wrong::kNoRealTimeClock); }
  [[nodiscard]] std::int64_t clock_ahead_s() const {
    if (is(Wrong::kNoRealTimeClock)) return -10 * 365 * 86'400LL;
    if (is(Wrong::kClockBehind)) return -2;
    return is(Wrong::kClockAhead) ? 20 * 3600 : 0;
  }

  void start(bool is_again) {
    std::vector<std::pair<std::string, std::string>> environment{{"LD_PRELOAD", EARSHOT_SICK_HOST ":" EARSHOT_SICK_DISK},
                                                                 {"EARSHOT_TEST_DISK", sickness()},
                                                                 {"EARSHOT_TEST_DISK_HAS_RECORD", "1"},
                                                                 {"EARSHOT_TEST_DISK_IS_SICK", (folder_ / "sick").string()},
                                                                 {"STATE_DIRECTORY", (folder_ / "state").string()}};
    if (has_memory_) environment.emplace_back("RUNTIME_DIRECTORY", (folder_ / "memory").string());
    if (is_again) environment.emplace_back("EARSHOT_TEST_CLOCK_S", std::to_string(clock_ahead_s()));
    if (is_again && is_in_new_boot()) environment.emplace_back("EARSHOT_TEST_BOOT", (folder_ / "boot").string());
    if (is_again && is(Wrong::kFewFiles)) environment.emplace_back("EARSHOT_TEST_FILES", std::to_string(kFewFiles));
    if (is_again && is(Wrong::kFewThreads)) environment.emplace_back("EARSHOT_TEST_THREADS", std::to_string(below(5)));
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    std::vector<std::string> arguments{"--resume", "--speed", "10"};
    if (is_again && is(Wrong::kOptionsInConflict)) {
      const std::vector<std::string>& conflict = kConflicts[below(static_cast<std::uint32_t>(std::size(kConflicts)))];
      arguments.insert(arguments.end(), conflict.begin(), conflict.end());
    }
    start_earshotd(arguments);
    for (const auto& [name, value] : environment) ::unsetenv(name.c_str());
  }

  /// @return whether it is durable
  bool give(Order order, const messages::OperatorLimits& limits = {}) {
    vehicle_->order(order, limits);
    EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome.has_value(); })) << earshotd_->output();
    EXPECT_TRUE(messages::was_obeyed(vehicle_->outcome.value_or(CommandOutcome::kTooOld))) << earshotd_->output();
    return vehicle_->outcome == CommandOutcome::kObeyed;
  }

  /// @return whether what was done must hold: it is durable, or in a memory that was not lost
  bool fly_until_killed() {
    start(false);
    EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > 2; })) << earshotd_->output();
    (void)give(Order::kStart);
    const auto steps = static_cast<std::int32_t>(below(3));
    EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->state() == MissionState::kSearch && vehicle_->health.steps_taken >= steps; }));
    if (is(Wrong::kRecordsRemovedInFlight) && sickness().empty()) {
      const std::vector<fs::path> removed = records();
      for (const fs::path& record : removed) fs::remove(record);
      EXPECT_TRUE(vehicle_->sails_until([&] { return records().size() == removed.size(); })) << "they are made anew";
    }
    if (!sickness().empty()) std::ofstream(folder_ / "sick") << "";
    bool is_durable = true;
    if (before_ == Before::kPaused) is_durable = give(Order::kPause);
    if (before_ == Before::kTightened) is_durable = give(Order::kTighten, {.max_depth = Meters{200}});
    if (before_ == Before::kAborted) is_durable = give(Order::kAbort);
    if (before_ == Before::kReleased) {
      vehicle_->leak();
      EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->is_released; })) << earshotd_->output();
      is_durable = sickness().empty() || sickness() == "crammed";  // a disk that is full takes what it holds already
      // It is not acknowledged: a busy disk may have it later than the vehicle.
      EXPECT_TRUE(vehicle_->sails_until([&] { return !is_durable || is_release_on_disk(); })) << earshotd_->output();
    }
    // What is refused comes at any moment.
    for (std::uint32_t i = below(20); i > 0; --i) (void)vehicle_->sails_until([] { return true; });
    earshotd_->signal(is(Wrong::kStoppedInOrder) ? SIGTERM : SIGKILL);
    (void)earshotd_->wait(std::chrono::seconds(30));
    return is_durable || (has_memory_ && !is_in_new_boot());
  }

  void flip_bit(const fs::path& path) {
    const auto size = static_cast<std::uint32_t>(fs::file_size(path));
    const std::uint32_t at = path.extension() == ".safety" ? below(4096 * 2 + 6000) : below(size);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const int byte = file.get();
    file.seekp(at);
    file.put(static_cast<char>(byte ^ (1 << below(8))));
  }

  /// The copies on a disk.
  [[nodiscard]] std::vector<fs::path> records() const {
    std::vector<fs::path> records;
    if (fs::exists(folder_ / "journal.safety")) records.push_back(folder_ / "journal.safety");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "state")) records.push_back(entry.path());
    return records;
  }

  [[nodiscard]] bool is_release_on_disk() const {
    return std::ranges::all_of(records(), [](const fs::path& record) {
      host::RecordFile file(record);
      return file.open() && file.newest().value_or(host::SafetyRecord{}).is_released;
    });
  }

  /// Makes another record of one that stands in a copy.
  void change(const fs::path& path, const std::function<void(host::SafetyRecord&)>& how) {
    host::RecordFile file(path);
    if (!file.open()) return;
    std::optional<host::SafetyRecord> record = file.newest();
    if (!record) return;
    how(*record);
    EXPECT_TRUE(file.write(*record));
  }
  /// A card that was away comes back with another flight's record, which has ended, and with a higher number.
  static void make_stale(host::SafetyRecord& record) {
    record.journal_crc32 ^= 1U;
    record.sequence += 1000;
    record.is_closed = true;
    record.since_boot = record.since_boot - Duration::seconds(1000);
    record.utc = record.utc + Duration::seconds(-1000);
  }
  static void make_record_of_another(host::SafetyRecord& record) {
    record.owner.computer ^= 1U;
    record.sequence += 1000;
    record.is_closed = true;
  }
  /// Somebody has the records, and has not written them for long.
  void let_holder_stall() {
    for (const fs::path& record : records()) {
      change(record, [](host::SafetyRecord& held) {
        ++held.sequence;
        held.since_boot = held.since_boot - Duration::seconds(60);
      });
      holders_.emplace_back(::open(record.c_str(), O_RDONLY | O_CLOEXEC));
      EXPECT_EQ(::flock(holders_.back().number(), LOCK_SH | LOCK_NB), 0);
    }
  }

  void go_wrong() {
    if (sickness() != "slow" && below(2) == 0) fs::remove(folder_ / "sick");  // it is well again
    std::ofstream(folder_ / "boot") << "0b1c61e7-6b43-4a5c-9f0e-2d1f5f3b6a8c\n";
    if (is_in_new_boot()) fs::remove_all(folder_ / "memory"), fs::create_directory(folder_ / "memory");
    if (is(Wrong::kBitInJournal)) flip_bit(folder_ / "journal.lcmlog");
    const std::vector<fs::path> records = this->records();
    ASSERT_FALSE(records.empty()) << "no disk has a record";
    const fs::path record = records[below(static_cast<std::uint32_t>(records.size()))];
    if (is(Wrong::kBitInRecord)) flip_bit(record);
    if (is(Wrong::kStaleCopy)) change(record, make_stale);
    if (is(Wrong::kOthersRecord)) change(record, make_record_of_another);
    if (is(Wrong::kNoRecord)) fs::remove(record);
    if (is(Wrong::kHolderThatHangs) && !is_in_new_boot()) let_holder_stall();
    if (is(Wrong::kSilentSensors)) vehicle_->fall_silent();
    if (is(Wrong::kNoJournal)) fs::remove(folder_ / "journal.lcmlog");
    if (is(Wrong::kNoMission)) fs::remove(folder_ / "mission.toml");
    if (is(Wrong::kNoPolicy)) fs::remove(folder_ / "walk.policy");
    if (is(Wrong::kNoKey)) fs::remove(folder_ / "walk.pub");
    if (is(Wrong::kSecondOwner)) owner_.emplace(host::lock_lcm(host::kDefaultLcmUrl));
    vehicle_->clock_is_ahead = Duration::seconds(clock_ahead_s());
    vehicle_->health = {};
    vehicle_->setpoints = 0;
  }

  void expect_what_was_ordered(bool holds, bool comes_up) const {
    if (!holds || comes_up) {
      EXPECT_TRUE(!holds || before_ != Before::kReleased || vehicle_->is_released) << "a release was forgotten" << earshotd_->output();
      return;
    }
    EXPECT_NE(before_, Before::kAborted) << "an ABORT was forgotten" << earshotd_->output();
    EXPECT_NE(before_, Before::kReleased) << "a release was forgotten" << earshotd_->output();
    EXPECT_TRUE(before_ != Before::kPaused || vehicle_->health.paused != 0) << "a PAUSE was forgotten" << earshotd_->output();
    EXPECT_TRUE(before_ != Before::kTightened || vehicle_->depth() <= Meters{200}) << "a TIGHTEN was forgotten" << earshotd_->output();
  }

  Pcg32 random_{static_cast<std::uint64_t>(GetParam())};
  Before before_{};
  std::vector<Wrong> wrongs_;
  bool has_memory_ = false;
  std::optional<VehicleOverLcm> vehicle_;
  std::optional<host::BusLock> owner_;
  std::vector<host::FileDescriptor> holders_;
};

TEST_P(Outages, AreFollowedByACommandToGoOnOrToComeUpAndNothingThatWasAcknowledgedIsForgotten) {
  SCOPED_TRACE(std::string("before: ") + std::to_string(static_cast<int>(before_)) + "; " + kWords[static_cast<int>(wrongs_[0])] + " and " +
               kWords[static_cast<int>(wrongs_[1])] + (has_memory_ ? ", with memory" : ""));
  const bool holds = fly_until_killed();
  go_wrong();
  const auto began = steady_clock::now();
  start(true);
  const auto is_commanded = [&] { return vehicle_->setpoints > 0 && vehicle_->state() != MissionState::kStandby; };
  EXPECT_TRUE(vehicle_->sails_until([&] { return is_commanded() || steady_clock::now() - began > std::chrono::seconds(20); }));
  EXPECT_TRUE(is_commanded()) << earshotd_->output();
  // Where many are asked for, the computer is theirs.
  const std::chrono::seconds most(std::getenv("EARSHOT_OUTAGES") == nullptr ? 20 : 10);
  EXPECT_LT(steady_clock::now() - began, most) << earshotd_->output();
  const int turns = vehicle_->turns;
  EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > turns + 2; })) << "it goes on" << earshotd_->output();
  const bool comes_up = vehicle_->state() == MissionState::kAbort && vehicle_->depth() == Meters{0.0};
  EXPECT_TRUE(comes_up || vehicle_->state() == MissionState::kSearch) << earshotd_->output();
  expect_what_was_ordered(holds, comes_up);
  const auto asked = steady_clock::now();
  vehicle_->order(Order::kAbort);
  EXPECT_TRUE(vehicle_->sails_until([&] { return vehicle_->outcome.has_value() && vehicle_->state() == MissionState::kAbort; }))
      << "an ABORT is not answered" << earshotd_->output();
  EXPECT_LT(steady_clock::now() - asked, most) << earshotd_->output();
}

INSTANTIATE_TEST_SUITE_P(Seed, Outages,
                         testing::Range(number_in("EARSHOT_OUTAGES_FROM", 0),
                                        number_in("EARSHOT_OUTAGES_FROM", 0) + number_in("EARSHOT_OUTAGES", 16)));

}  // namespace
}  // namespace earshot
