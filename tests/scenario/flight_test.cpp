// Whole flights: the programs themselves, over real LCM and real DDS.

#include "tests/scenario/flight.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <sstream>

#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

TEST_F(Flight, GivenOneSeedTwoFlightsGoTheSameWayByteForByte) {
  shorten_to(25);
  for (const char* out : {"first", "second"}) {
    const auto flight = fly(out, {"--seed", "7"});
    ASSERT_EQ(flight->wait(120s), 0) << flight->output();
  }
  EXPECT_EQ(summary("first").at("steps"), 25);
  const std::string track = support::read_text(folder_ / "first/track.csv");
  EXPECT_GT(track.size(), 1000);
  EXPECT_TRUE(track == support::read_text(folder_ / "second/track.csv"));
  EXPECT_TRUE(support::read_text(folder_ / "first/journal.lcmlog") == support::read_text(folder_ / "second/journal.lcmlog"));
}

TEST_F(Flight, GivenAJournalThatSurvivesAPowerCutAsAtSeaTheFlightGoesTheSameWayAndTheJournalIsTheSame) {
  const auto left_to_the_kernel = fly("process", {"--seed", "1"});
  ASSERT_EQ(left_to_the_kernel->wait(120s), 0) << left_to_the_kernel->output();
  const auto as_at_sea = fly("power-cut", {"--seed", "1", "--journal-survives", "power-cut"});
  ASSERT_EQ(as_at_sea->wait(120s), 0) << as_at_sea->output();
  for (const char* file : {"track.csv", "journal.lcmlog"})
    EXPECT_TRUE(support::read_text(folder_ / "process" / file) == support::read_text(folder_ / "power-cut" / file)) << file;
}

TEST_F(Flight, GivenTwoSeedsTheyStartElsewhere) {
  shorten_to(1);
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
    if (record.channel == wire::kHealthChannel) (void)support::read_peer(record.data, health);
  }
  EXPECT_EQ(s.at("steps"), decisions);
  EXPECT_EQ(health.steps_taken, decisions);
  EXPECT_NE(flight->output().find("steps       " + std::to_string(decisions) + " of "), std::string::npos) << flight->output();
}

TEST_F(Flight, GivenAFolderThatIsNamedLikeAnOptionItWritesItsReportThere) {
  fs::current_path(folder_);
  const std::vector<std::string> arguments{"--mission", kMission, "--out", "-x", "--seed", "7", "--source", "fixed"};
  const auto flight = std::make_unique<support::Process>(kBin / "earshot-fly", arguments, folder_ / "text");
  EXPECT_EQ(flight->wait(120s), 0) << flight->output();
  EXPECT_TRUE(fs::exists(folder_ / "-x/report.html")) << flight->output();
  fs::current_path("/");
}

TEST_F(Flight, GivenAnotherFlightsNavigationOnItsBusItRefusesItAndSaysSoInHealth) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  host::LcmEndpoint other(host::parse_lcm_url(slot_.lcm_url()), {});
  for (int i = 0; i < 20; ++i) {
    nav_state_t outside{};  // of the operating area: believed, it would end the mission
    outside.utime = 1 + i;
    outside.north_m = -1e6;
    ASSERT_EQ(other.publish(wire::kNavStateChannel, support::bytes_of(outside)), Status::kOk);
    std::this_thread::sleep_for(5ms);
  }
  simulator_->signal(SIGINT);
  EXPECT_EQ(runtime_->wait(5s), program::kAborted);
  EXPECT_NE(runtime_->output().find("ABORT, an operator aborted it"), std::string::npos) << runtime_->output();
  health_t health{};
  host::JournalReader reader(folder_ / "journal.lcmlog");
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel == wire::kHealthChannel) (void)support::read_peer(record.data, health);
  }
  EXPECT_EQ(health.navigation_refused, 20);
}

TEST_F(Flight, GivenTwoFlightsAtOnceNeitherHearsTheOther) {
  const auto other = fly("other", {"--seed", "6", "--speed", "500"});  // at least 100 s long
  ASSERT_TRUE(is_under_way("other")) << other->output();
  shorten_to(25);
  const auto beside = fly("beside", {"--seed", "5"});
  EXPECT_EQ(beside->wait(60s), 0) << beside->output();
  other->signal(SIGINT);
  EXPECT_EQ(other->wait(5s), 130) << other->output();
  const auto alone = fly("alone", {"--seed", "5"});
  ASSERT_EQ(alone->wait(60s), 0) << alone->output();
  EXPECT_EQ(summary("alone").at("steps"), 25);
  EXPECT_TRUE(support::read_text(folder_ / "alone/track.csv") == support::read_text(folder_ / "beside/track.csv"));
}

/// A bus that no other test, flight or mission is on.
std::string own_url(const link::RunSlot& slot) {
  return "udpm://239.255.76.67:" + std::to_string(27'000 + slot.domain()) + "?ttl=0";
}

TEST_F(Flight, GivenAFlightOnABusASecondOneThereIsRefusedAndTheFirstGoesOnAsIfAlone) {
  const std::string url = own_url(slot_);
  const auto alone = fly("alone", {"--seed", "5", "--lcm-url", url});
  ASSERT_EQ(alone->wait(120s), 0) << alone->output();
  const auto first = fly("first", {"--seed", "5", "--lcm-url", url, "--speed", "10000"});
  ASSERT_TRUE(is_under_way("first")) << first->output();
  const auto second = fly("second", {"--seed", "6", "--lcm-url", url});
  EXPECT_EQ(second->wait(10s), 2);
  EXPECT_EQ(second->output(), "earshot fly: " + url + ": earshot-fly (process " + std::to_string(first->pid()) + ") is using it\n");
  EXPECT_FALSE(fs::exists(folder_ / "second"));
  EXPECT_EQ(first->wait(120s), 0) << first->output();
  EXPECT_TRUE(support::read_text(folder_ / "alone/track.csv") == support::read_text(folder_ / "first/track.csv"));
}

TEST_F(Flight, GivenACanInterfaceInUseAFlightThereIsRefused) {
  const host::BusLock held = host::lock_can("vcan-held");
  const auto flight = fly("out", {"--bus", "can", "--can-interface", "vcan-held"});
  EXPECT_EQ(flight->wait(10s), 2);
  EXPECT_TRUE(support::lines_tell(flight->output(), {{"fly", "CAN", "flight_test", std::to_string(getpid()), "using"}}));
}

TEST_F(Flight, GivenAMissionAtSeaAFlightOnItsBusIsRefusedAndOneWithNoBusNamedTakesAnother) {
  const std::string url = own_url(slot_);
  std::vector<std::string> a = policy_arguments();
  a.insert(a.end(), {kMission, "--out", folder_.path(), "--lcm-url", url});
  runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
  ASSERT_TRUE(has_journal()) << runtime_->output();
  EXPECT_EQ(fly("there", {"--lcm-url", url})->wait(10s), 2);
  EXPECT_EQ(fly("elsewhere", {})->wait(120s), 0);
}

TEST_F(Flight, GivenHalvesOfAFlightStartedByHandASecondRuntimeOnItsBusAndASecondSimulatorInItsFolderAreRefusedAndTheFlightGoesOn) {
  start_both();
  ASSERT_TRUE(is_under_way()) << runtime_->output() << simulator_->output();
  const std::string domain = std::to_string(slot_.domain() + 1);
  std::vector<std::string> a = policy_arguments();
  a.insert(a.end(), {kMission, "--out", folder_ / "other", "--simulation", domain, "--lcm-url", slot_.lcm_url()});
  support::Process second(kBin / "earshotd", a, folder_ / "second.txt");
  EXPECT_EQ(second.wait(10s), 2);
  EXPECT_EQ(second.output(), "earshotd: " + slot_.lcm_url() + ": earshotd (process " + std::to_string(runtime_->pid()) + ") is using it\n");
  EXPECT_THROW((void)host::lock_folder(folder_), host::FolderInUse) << "the simulator writes there";
  EXPECT_THROW(host::require_not_being_written(folder_ / "journal.lcmlog"), host::FolderInUse) << "earshotd writes it";
  runtime_->signal(SIGTERM);
  EXPECT_EQ(runtime_->wait(20s), program::kInterrupted) << runtime_->output();
  EXPECT_EQ(simulator_->wait(20s), 0) << "it was told of the ABORT: " << simulator_->output();
  EXPECT_EQ(nlohmann::json::parse(support::read_text(folder_ / "summary.json")).at("end_reason"), "interrupted");
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
  EXPECT_EQ(flight->output(), (folder_ / "walk.policy").string() + ": is damaged: its CRC-32 is wrong\n");
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

TEST_F(Flight, GivenNoOceanAndNoMissionItFliesTheOnesThatShip) {
  support::Process flight(kBin / "earshot-fly", {"--out", folder_ / "out", "--no-report"}, folder_ / "text");
  ASSERT_EQ(flight.wait(60s), 0) << flight.output();
  EXPECT_EQ(fs::path(summary("out").at("mission")).filename(), "search.toml");
  EXPECT_EQ(fs::path(summary("out").at("environment")).filename(), "munk_flat.toml");
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
  EXPECT_TRUE(support::lines_tell(verb.output(), {{"earshot", "no", "swim", "mean sim"}}));
}

}  // namespace
}  // namespace earshot
