// Whole flights: the programs themselves, over real LCM and real DDS.

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "firmware/boards/linux/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "sim/link/run_slot.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kSource = EARSHOT_SOURCE_DIR;
const fs::path kBin = EARSHOT_BIN_DIR;
const fs::path kMission = kSource / "firmware/boards/linux/missions/fixed_source.toml";
const fs::path kEnvironment = kSource / "sim/ocean/environments/munk_flat.toml";

class Flight : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("earshot-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(support::random_walk_policy()));
    support::write_public_key(folder_ / "walk.pub");
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  [[nodiscard]] std::vector<std::string> policy_arguments() const {
    return {"--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub"};
  }

  /// A flight by earshot-fly with a policy that walks at random.
  [[nodiscard]] std::unique_ptr<support::Process> fly(const std::string& out, std::vector<std::string> more,
                                                      const fs::path& environment = kEnvironment) const {
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {"--environment", environment, "--mission", kMission, "--out", folder_ / out, "--no-report"});
    a.insert(a.end(), more.begin(), more.end());
    return std::make_unique<support::Process>(kBin / "earshot-fly", a, folder_ / (out + ".txt"));
  }

  /// Both processes of one flight without earshot-fly between them and the test.
  void start_both() {
    const std::string domain = std::to_string(slot_.domain());
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {kMission, "--out", folder_, "--simulation", domain, "--lcm-url", slot_.lcm_url()});
    runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
    simulator_ = std::make_unique<support::Process>(
        kBin / "earshot-sim",
        std::vector<std::string>{"--environment", kEnvironment, "--mission", kMission, "--out", folder_, "--domain", domain, "--lcm-url",
                                 slot_.lcm_url(), "--ignore-source", "--speed", "500"},
        folder_ / "earshot-sim.txt");
  }

  /// Until the journal holds some minutes at sea.
  [[nodiscard]] bool is_under_way() const {
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      for (const fs::path& journal : {folder_ / "journal.lcmlog", folder_ / "unfinished-flight/journal.lcmlog"}) {
        std::error_code error;
        if (fs::exists(journal) && fs::file_size(journal, error) > 50'000) return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }

  /// Until there is a journal, whatever its name: its mission is on the bus.
  [[nodiscard]] bool has_journal() const {
    for (const auto deadline = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < deadline;) {
      for (const auto& file : fs::directory_iterator(folder_)) {
        if (file.path().extension() == ".lcmlog") return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }

  struct Contents {
    std::size_t records = 0;
    host::JournalReader::End end = host::JournalReader::End::kCorrupt;
  };
  [[nodiscard]] Contents journal() const {
    host::JournalReader reader(folder_ / "journal.lcmlog");
    Contents contents;
    for (host::JournalRecord record; reader.next(record);) ++contents.records;
    contents.end = reader.end();
    return contents;
  }

  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(support::read_text(folder_ / out / "summary.json"));
  }

  fs::path folder_;
  const link::RunSlot slot_;
  std::unique_ptr<support::Process> runtime_;
  std::unique_ptr<support::Process> simulator_;
};

TEST_F(Flight, GivenOneSeedTwoFlightsGoTheSameWayByteForByte) {
  for (const char* out : {"first", "second"}) {
    const auto flight = fly(out, {"--seed", "7"});
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  const std::string track = support::read_text(folder_ / "first/track.csv");
  EXPECT_GT(track.size(), 1000);
  EXPECT_TRUE(track == support::read_text(folder_ / "second/track.csv"));
  EXPECT_TRUE(support::read_text(folder_ / "first/journal.lcmlog") == support::read_text(folder_ / "second/journal.lcmlog"));
}

TEST_F(Flight, GivenTwoSeedsTheyStartElsewhere) {
  for (const char* seed : {"7", "8"}) {
    const auto flight = fly(seed, {"--seed", seed});
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  EXPECT_NE(summary("7").at("start"), summary("8").at("start"));
}

TEST_F(Flight, GivenAnEnvironmentWithConditionsWhatIsHeardFollowsThemAndTheSameSeedHearsTheSame) {
  const fs::path noisy = folder_ / "noisy.toml";
  std::ofstream(noisy) << support::read_text(kEnvironment) << "\n[conditions]\nfluctuation_db = 4.0\nfloor_db = 5.0\n";
  for (const char* out : {"first", "second"}) {
    const auto flight = fly(out, {"--seed", "7"}, noisy);
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  const std::string track = support::read_text(folder_ / "first" / "track.csv");
  EXPECT_EQ(track, support::read_text(folder_ / "second" / "track.csv"));
  std::istringstream rows(track);
  std::string row;
  std::getline(rows, row);
  double last_db = 0.0;
  double greatest_change_db = 0.0;
  bool was_too_faint = false;
  while (std::getline(rows, row)) {
    std::size_t place = 0;
    for (int comma = 0; comma < 6; ++comma) place = row.find(',', place) + 1;
    const double snr_db = std::stod(row.substr(place));
    EXPECT_GE(snr_db, 5.0) << row;
    was_too_faint = was_too_faint || snr_db == 5.0;
    if (last_db > 5.0 && snr_db > 5.0) greatest_change_db = std::max(greatest_change_db, std::abs(snr_db - last_db));
    last_db = snr_db;
  }
  EXPECT_TRUE(was_too_faint);
  EXPECT_GT(greatest_change_db, 3.0) << "2 m further on the modelled SNR is nearly the same";
}

TEST_F(Flight, GivenAWholeMissionItsSummaryAgreesWithItsTrack) {
  const auto flight = fly("out", {"--seed", "3", "--ignore-source"});
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  const nlohmann::json s = summary("out");
  EXPECT_EQ(s.at("steps"), 100);
  EXPECT_EQ(s.at("found"), false);
  EXPECT_EQ(s.at("end_reason"), "steps_used_up");
  // 100 legs of 1 km; each turn adds at most half a turning circle of 19 m radius, and the safety layer may shorten a leg at the edge.
  EXPECT_NEAR(s.at("distance_m").get<double>(), 100e3, 6e3);
  EXPECT_NEAR(s.at("sim_time_s").get<double>(), s.at("distance_m").get<double>() / 2.0, 100.0);
  EXPECT_EQ(host::JournalReader(folder_ / "out/journal.lcmlog").end(), host::JournalReader::End::kWhole);
}

TEST_F(Flight, GivenASourceReachedInTheMiddleOfAStepJournalSummaryAndConsoleCountThatStepToo) {
  // With the shipped policy, which finds the source; it comes within reach at a tick, of which a step of 1 km at 2 m/s has 500.
  const auto flight =
      std::make_unique<support::Process>(kBin / "earshot-fly",
                                         std::vector<std::string>{"--environment", kEnvironment, "--mission", kMission, "--out",
                                                                  folder_ / "out", "--no-report", "--seed", "7", "--source", "fixed"},
                                         folder_ / "text");
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  const nlohmann::json s = summary("out");
  ASSERT_EQ(s.at("found"), true);
  int decisions = 0;
  health_t health{};
  host::JournalReader reader(folder_ / "out/journal.lcmlog");
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel == wire::kDecisionChannel) ++decisions;
    if (record.channel == wire::kHealthChannel) (void)wire::decode(record.data, health);
  }
  EXPECT_EQ(s.at("steps"), decisions);
  EXPECT_EQ(health.steps_taken, decisions);
  EXPECT_NE(flight->output().find("steps       " + std::to_string(decisions) + "\n"), std::string::npos) << flight->output();
}

TEST_F(Flight, GivenItsRuntimeIsKilledTheSimulatorSaysSoWithinFiveSecondsAndKeepsTheTrack) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  runtime_->signal(SIGKILL);
  EXPECT_EQ(simulator_->wait(5s), 3);
  EXPECT_NE(simulator_->output().find("lost earshotd"), std::string::npos) << simulator_->output();
  EXPECT_EQ(nlohmann::json::parse(support::read_text(folder_ / "summary.json")).at("end_reason"), "earshotd_lost");
  EXPECT_GT(support::read_text(folder_ / "track.csv").size(), 1000);
  // What the killed process had handed to the kernel is there; at most its last record is cut.
  EXPECT_GT(journal().records, 100);
  EXPECT_NE(journal().end, host::JournalReader::End::kCorrupt);
}

TEST_F(Flight, GivenItsSimulatorIsKilledTheRuntimeSaysSoWithinFiveSecondsAndItsJournalIsWhole) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  simulator_->signal(SIGKILL);
  EXPECT_EQ(runtime_->wait(5s), 3);
  EXPECT_NE(runtime_->output().find("lost the simulator"), std::string::npos) << runtime_->output();
  EXPECT_GT(journal().records, 100);
  EXPECT_EQ(journal().end, host::JournalReader::End::kWhole);
  EXPECT_FALSE(fs::exists(folder_ / "summary.json"));
}

TEST_F(Flight, GivenAFullDiskTheFlightIsLostWithStatusThreeAndEveryRowThatWasWrittenIsKept) {
  const std::string domain = std::to_string(slot_.domain());
  std::vector<std::string> a = policy_arguments();
  a.insert(a.end(), {kMission, "--out", folder_, "--simulation", domain, "--lcm-url", slot_.lcm_url()});
  runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
  // A limit on the size of one file stands for the disk: room for snr.csv (some 60 kB) and for some 2000 of 50 000 rows of the track.
  simulator_ = std::make_unique<support::Process>(
      "/bin/bash",
      std::vector<std::string>{"-c", "trap '' XFSZ; ulimit -f 200; exec \"$@\"", "bash", kBin / "earshot-sim", "--environment",
                               kEnvironment, "--mission", kMission, "--out", folder_, "--domain", domain, "--lcm-url", slot_.lcm_url(),
                               "--ignore-source"},
      folder_ / "earshot-sim.txt");
  EXPECT_EQ(simulator_->wait(60s), 3) << simulator_->output();
  EXPECT_NE(simulator_->output().find("track.csv"), std::string::npos) << simulator_->output();
  EXPECT_EQ(runtime_->wait(10s), 3) << runtime_->output();
  const nlohmann::json s = nlohmann::json::parse(support::read_text(folder_ / "summary.json"));
  EXPECT_EQ(s.at("end_reason"), "simulator_failed");
  EXPECT_FALSE(fs::exists(folder_ / "track.csv.partial"));
  const std::string track = support::read_text(folder_ / "track.csv");
  EXPECT_GT(track.size(), 200'000);
  EXPECT_EQ(track.back(), '\n');
}

TEST_F(Flight, GivenCtrlCBothEndInOrderAndTheJournalIsWhole) {
  const auto flight = fly(".", {"--speed", "500", "--ignore-source"});
  ASSERT_TRUE(is_under_way()) << flight->output();
  flight->signal(SIGINT);
  EXPECT_EQ(flight->wait(5s), 130) << flight->output();
  EXPECT_EQ(summary(".").at("end_reason"), "interrupted");
  EXPECT_NE(flight->output().find("source not found: interrupted"), std::string::npos) << flight->output();
  EXPECT_EQ(journal().end, host::JournalReader::End::kWhole);
}

TEST_F(Flight, GivenAnotherFlightsNavigationOnItsBusItRefusesItAndSaysSoInHealth) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  host::LcmEndpoint other(host::parse_lcm_url(slot_.lcm_url()), {});
  for (int i = 0; i < 20; ++i) {
    nav_state_t outside{};  // of the operating area: believed, it would end the mission
    outside.utime = 1 + i;
    outside.north_m = -1e6;
    ASSERT_EQ(other.publish(wire::kNavStateChannel, wire::Encoded(outside).bytes()), Status::kOk);
    std::this_thread::sleep_for(5ms);
  }
  simulator_->signal(SIGINT);
  EXPECT_EQ(runtime_->wait(5s), 0);
  EXPECT_NE(runtime_->output().find("ABORT, an operator aborted it"), std::string::npos) << runtime_->output();
  health_t health{};
  host::JournalReader reader(folder_ / "journal.lcmlog");
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel == wire::kHealthChannel) (void)wire::decode(record.data, health);
  }
  EXPECT_EQ(health.navigation_refused, 20);
}

TEST_F(Flight, GivenItDiedAtSeaItStartsAgainBesideTheJournalThatIsThere) {
  // earshotd holds the lock on its address itself, and the slot's is taken: a port that goes with the slot and is none.
  const std::string url = "udpm://239.255.76.67:" + std::to_string(20'000 + slot_.domain()) + "?ttl=0";
  const auto start_at_sea = [this, &url](const char* text) {
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {kMission, "--out", folder_, "--lcm-url", url});
    runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / text);
  };
  const auto wait_for_records = [this](const char* name) {
    std::error_code error;
    for (int i = 0; i < 1000 && !(fs::exists(folder_ / name) && fs::file_size(folder_ / name, error) > 0); ++i)
      std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(fs::exists(folder_ / name)) << runtime_->output();
  };
  start_at_sea("first.txt");
  wait_for_records("journal.lcmlog");
  runtime_->signal(SIGKILL);
  (void)runtime_->wait(5s);
  start_at_sea("second.txt");
  wait_for_records("journal-2.lcmlog");
  runtime_->signal(SIGTERM);
  EXPECT_EQ(runtime_->wait(5s), 0);
  EXPECT_NE(runtime_->output().find("journal-2.lcmlog"), std::string::npos) << runtime_->output();
  EXPECT_GT(journal().records, 0);
}

TEST_F(Flight, GivenTwoFlightsAtOnceNeitherHearsTheOther) {
  const auto alone = fly("alone", {"--seed", "5"});
  ASSERT_EQ(alone->wait(120s), 0) << alone->output();
  const auto one = fly("one", {"--seed", "5"});
  const auto other = fly("other", {"--seed", "6"});
  EXPECT_EQ(one->wait(120s), 0) << one->output();
  EXPECT_EQ(other->wait(120s), 0) << other->output();
  EXPECT_TRUE(support::read_text(folder_ / "alone/track.csv") == support::read_text(folder_ / "one/track.csv"));
}

/// A bus that no other test, flight or mission is on.
std::string own_url(const link::RunSlot& slot) {
  return "udpm://239.255.76.67:" + std::to_string(27'000 + slot.domain()) + "?ttl=0";
}

TEST_F(Flight, GivenAFlightOnABusASecondOneThereIsRefusedAndTheFirstGoesOnAsIfAlone) {
  const std::string url = own_url(slot_);
  const auto alone = fly("alone", {"--seed", "5", "--lcm-url", url});
  ASSERT_EQ(alone->wait(120s), 0) << alone->output();
  const auto first = fly(".", {"--seed", "5", "--lcm-url", url, "--speed", "10000"});
  ASSERT_TRUE(is_under_way()) << first->output();
  const auto second = fly("second", {"--seed", "6", "--lcm-url", url});
  EXPECT_EQ(second->wait(10s), 2);
  EXPECT_EQ(second->output(), "earshot fly: " + url + ": another mission or flight on this machine is using it\n");
  EXPECT_FALSE(fs::exists(folder_ / "second"));
  EXPECT_EQ(first->wait(120s), 0) << first->output();
  EXPECT_TRUE(support::read_text(folder_ / "alone/track.csv") == support::read_text(folder_ / "track.csv"));
}

TEST_F(Flight, GivenACanInterfaceInUseAFlightThereIsRefused) {
  const host::FileDescriptor held = host::lock_can("vcan-held");
  const auto flight = fly("out", {"--bus", "can", "--can-interface", "vcan-held"});
  EXPECT_EQ(flight->wait(10s), 2);
  EXPECT_EQ(flight->output(), "earshot fly: CAN interface vcan-held: another mission or flight on this machine is using it\n");
}

TEST_F(Flight, GivenAMissionAtSeaAFlightOnItsBusIsRefusedAndOneWithNoBusNamedTakesAnother) {
  const std::string url = own_url(slot_);
  std::vector<std::string> a = policy_arguments();
  a.insert(a.end(), {kMission, "--out", folder_, "--lcm-url", url});
  runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
  ASSERT_TRUE(has_journal()) << runtime_->output();
  EXPECT_EQ(fly("there", {"--lcm-url", url})->wait(10s), 2);
  EXPECT_EQ(fly("elsewhere", {})->wait(120s), 0);
}

TEST_F(Flight, GivenItsJournalAloneTheRuntimeGivesEveryByteAgain) {
  const auto flight = fly("out", {"--seed", "7"});
  ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  const board::ReplayResult replayed = board::replay(folder_ / "out/journal.lcmlog");
  EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
  EXPECT_EQ(replayed.end, host::JournalReader::End::kWhole);
  EXPECT_GT(replayed.turns, 400);
  EXPECT_GT(replayed.decisions, 0);
}

TEST_F(Flight, GivenADamagedPolicyNothingFliesAndTheMessageNamesIt) {
  std::vector<std::uint8_t> bytes = support::signed_bytes(support::random_walk_policy());
  bytes[bytes.size() / 2] ^= 1U;
  support::write_bytes(folder_ / "walk.policy", bytes);
  const auto flight = fly("out", {});
  EXPECT_EQ(flight->wait(10s), 2);
  EXPECT_EQ(flight->output(), (folder_ / "walk.policy").string() + ": its CRC-32 is wrong: the file is damaged\n");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Flight, GivenAMissionBelowTheSeaFloorOneLineNamesFileAndKeyAndNothingIsWritten) {
  std::string text = support::read_text(kMission);
  text.replace(text.find("depth_m = 300.0"), 15, "depth_m = 3500.0");
  text.replace(text.find("max_depth_m = 400.0"), 19, "max_depth_m = 4000.0");
  std::ofstream(folder_ / "deep.toml") << text;
  const std::string complaint = (folder_ / "deep.toml").string() +
                                ": search.depth_m = 3500: must be less than 3000, the seabed.depth_m of " + kEnvironment.string() + "\n";
  for (const char* program : {"earshot-fly", "earshot-sim"}) {
    support::Process flight(kBin / program, {"--environment", kEnvironment, "--mission", folder_ / "deep.toml", "--out", folder_ / "out"},
                            folder_ / "text");
    EXPECT_EQ(flight.wait(10s), 2) << program;
    EXPECT_EQ(flight.output(), complaint) << program;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << program;
  }
}

TEST_F(Flight, GivenAMissingMissionOneLineSaysSo) {
  support::Process flight(kBin / "earshot-fly", {"--environment", kEnvironment, "--mission", folder_ / "none.toml"}, folder_ / "text");
  EXPECT_EQ(flight.wait(10s), 2);
  EXPECT_EQ(flight.output(), (folder_ / "none.toml").string() + ": no such file\n");
}

TEST_F(Flight, GivenASpeedThatIsNoSpeedTheLineNamesItAndTheStatusIsTwo) {
  for (const char* speed : {"nan", "-1", "inf", "1e7", "1e-300", "fast"}) {
    for (const char* program : {"earshot-fly", "earshot-sim"}) {
      support::Process flight(kBin / program, {"--environment", kEnvironment, "--mission", folder_ / "none.toml", "--speed", speed},
                              folder_ / "text");
      EXPECT_EQ(flight.wait(10s), 2) << program << " " << speed;
      EXPECT_NE(flight.output().find("--speed"), std::string::npos) << program << " " << flight.output();
    }
  }
}

TEST_F(Flight, GivenAnUnknownOptionOrVerbTheStatusIsTwo) {
  support::Process flight(kBin / "earshot-fly", {"--sede", "7"}, folder_ / "text");
  EXPECT_EQ(flight.wait(10s), 2);
  support::Process verb(kBin / "earshot", {"swim"}, folder_ / "text2");
  EXPECT_EQ(verb.wait(10s), 2);
  EXPECT_EQ(verb.output(), "earshot: there is no verb \"swim\"; did you mean sim? (earshot help lists all)\n");
}

}  // namespace
}  // namespace earshot
