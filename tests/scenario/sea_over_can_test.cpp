// earshotd at sea, in scaled time, with the devices of an emulated vehicle (hil/nodes) on a CAN bus. Runs where vcan0 is
// (hil/bus/with-can).

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/transport/can_socket.hpp"
#include "firmware/messages/health.hpp"
#include "hil/nodes/pace.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"
#include "tests/scenario/short_walk.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

const fs::path kPrograms = EARSHOT_BIN_DIR;

/// The orders that were obeyed. The only reason not to is that one came more than 30 s after it was given, 0.6 s of the host's: a machine
/// that tests share may halt for so long, and the operator gives it anew.
std::vector<Order> obeyed(const hil::Operator& ashore) {
  std::vector<Order> orders;
  for (const messages::CommandAcknowledgement& answer : ashore.answers()) {
    const bool is_obeyed = answer.outcome == CommandOutcome::kObeyed;
    if (is_obeyed) orders.push_back(answer.order);
    EXPECT_TRUE(is_obeyed || answer.outcome == CommandOutcome::kTooOld) << static_cast<int>(answer.outcome);
  }
  return orders;
}

TEST_F(ShortWalk, GivenNavigationAndAutopilotOverCanAndTheRestOverLcmItIsSailedToItsLastStepAndItsJournalGivesEveryByteAgain) {
  const std::string url = "udpm://239.255.76.67:27491?ttl=0";
  PayloadOverLcm payload(url);
  std::vector<std::string> arguments = policy();
  arguments.insert(arguments.end(), {"--lcm-url", url});
  start_earshotd(walk_in("search_over_can.toml", 3), arguments);
  hil::VehicleSetup setup = in_the_middle();
  setup.without = {"hydrophone", "operator"};
  launch(setup);

  const auto turn = [&] { payload.turn(Decibels{3.0}); };
  ASSERT_TRUE(sails_until([&] { return payload.state() == MissionState::kSearch; }, 30s, turn)) << earshotd_->output();
  ASSERT_TRUE(sails_until([&] { return payload.state() != MissionState::kSearch; }, 120s, turn)) << earshotd_->output();
  EXPECT_EQ(payload.state(), MissionState::kDone);
  EXPECT_EQ(payload.health.end_reason, static_cast<std::int8_t>(EndReason::kStepsUsedUp));
  EXPECT_EQ(payload.health.steps_taken, 3);
  ASSERT_TRUE(sails_until([&] { return has_surfaced(); }, 60s, turn)) << earshotd_->output();
  end();

  const Voyage voyage(folder_ / "journal.lcmlog");
  expect_replayed(3);
  expect_taken(voyage.setpoints);
  expect_surfaced(voyage.fixes);
  ASSERT_FALSE(voyage.answers.empty());
  EXPECT_EQ(voyage.answers.front(), CommandOutcome::kObeyed);
  // Twenty times as fast, a halt of 5 ms while a frame gets its stamp dates a fix 100 ms late, and the next is older than that.
  EXPECT_LT(static_cast<double>(payload.health.navigation_refused), 0.1 * static_cast<double>(voyage.fixes.size()));
  EXPECT_EQ(bus_->lost(), 0U);
  // Three legs of 200 m, each of which ends within a turning circle of 19 m of its way-point. On a machine that halts for a while a turn
  // comes late, and the vehicle goes further: at 20 times the sea's speed 40 m in a second.
  EXPECT_GT(vehicle_->sailed().value, 3 * (200.0 - 2 * 19.0));
  std::cout << "sailed " << vehicle_->sailed().value << " m; " << voyage.fixes.size() << " fixes, " << voyage.setpoints.size()
            << " set-points, " << bus_->sent() << " frames\n";
}

TEST_F(ShortWalk, GivenAnOperatorWhoAbortsOverCanTheSearchEndsAndTheVehicleComesUp) {
  start_earshotd(walk_in("search_over_can_alone.toml"), policy());
  launch(in_the_middle());
  const hil::Operator& ashore = *vehicle_->operator_ashore();
  const auto is_in = [&](MissionState state) { return ashore.health() && ashore.health()->health.state == state; };
  const auto nothing = [] {};
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kSearch) && ashore.decisions() >= 2; }, 60s, nothing)) << earshotd_->output();
  vehicle_->operator_ashore()->abort();
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kAbort) && has_surfaced(); }, 60s, nothing)) << earshotd_->output();
  EXPECT_EQ(ashore.health()->health.end_reason, EndReason::kOperatorAbort);
  end(program::kAborted);
  const Voyage voyage(folder_ / "journal.lcmlog");
  expect_replayed(2);
  expect_taken(voyage.setpoints);
  expect_surfaced(voyage.fixes);
  EXPECT_EQ(obeyed(ashore), (std::vector{Order::kStart, Order::kAbort}));
}

TEST_F(ShortWalk, GivenALeakThatIsToldOnceARuleEndsTheSearchAndTheVehicleComesUp) {
  start_earshotd(walk_in("search_over_can_alone.toml") + "\n[[rule]]\nwhen = \"leak\"\nfor_s = 20.0\nthen = \"abort\"\n", policy());
  hil::VehicleSetup setup = in_the_middle();
  setup.without = {"hull-monitor"};
  launch(setup);
  const hil::Operator& ashore = *vehicle_->operator_ashore();
  const auto is_in = [&](MissionState state) { return ashore.health() && ashore.health()->health.state == state; };
  host::CanSocket hull("vcan0");
  // 65293: byte 3 is FD for wet, FC for dry.
  const auto say = [&](std::uint8_t state, std::uint8_t instance) {
    ASSERT_EQ(hull.send({.identifier = 0x04FF0D2C, .size = 8, .data = {0xFC, 0x9F, instance, state, 0xFF, 0xFF, 0xFF, 0xFF}}), Status::kOk);
  };
  hil::Pace pace(Duration::seconds(1));
  const auto dry_stern = [&] {
    if (pace.is_due(clock_.now())) say(0xFC, 1);
  };
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kSearch) && ashore.decisions() >= 2; }, 60s, dry_stern)) << earshotd_->output();
  say(0xFD, 0);
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kAbort) && has_surfaced(); }, 60s, dry_stern)) << earshotd_->output();
  EXPECT_EQ(ashore.health()->health.end_reason, EndReason::kSafetyRule);
  end(program::kAborted);
  EXPECT_NE(earshotd_->output().find(", leak"), std::string::npos) << earshotd_->output();
  expect_replayed(2);
}

TEST_F(ShortWalk, GivenSomebodyWhoTakesTheHelmARuleEndsTheSearch) {
  start_earshotd(walk_in("search_over_can_alone.toml") + "\n[[rule]]\nwhen = \"autopilot_disengaged\"\nthen = \"abort\"\n", policy());
  launch(in_the_middle());
  const hil::Operator& ashore = *vehicle_->operator_ashore();
  const auto is_in = [&](MissionState state) { return ashore.health() && ashore.health()->health.state == state; };
  const auto nothing = [] {};
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kSearch) && ashore.decisions() >= 2; }, 60s, nothing)) << earshotd_->output();
  vehicle_->autopilot()->engage(false);
  ASSERT_TRUE(sails_until([&] { return is_in(MissionState::kAbort); }, 60s, nothing)) << earshotd_->output();
  EXPECT_EQ(ashore.health()->health.end_reason, EndReason::kSafetyRule);
  end(program::kAborted);
  EXPECT_NE(earshotd_->output().find(", autopilot_disengaged"), std::string::npos) << earshotd_->output();
}

TEST_F(ShortWalk, GivenTheProgramThatEmulatesAVehicleItsOperatorStartsTheSearchAndItSailsUntilItsTimeIsOver) {
  start_earshotd(walk_in("search_over_can_alone.toml"), policy());
  for (int i = 0; i < 300 && earshotd_->output().find("journal.lcmlog") == std::string::npos; ++i) std::this_thread::sleep_for(100ms);
  support::Process vehicle(kPrograms / "earshot-emulate",
                           {"--mission", folder_ / "mission.toml", "--interface", "vcan0", "--speed", "20", "--start", "12500,12500",
                            "--source", "1000,1000", "--duration", "400"},
                           folder_ / "vehicle.txt");
  ASSERT_EQ(vehicle.wait(120s), 0) << vehicle.output();
  const std::string said = vehicle.output();
  for (const std::string line : {"is in STANDBY\n", "operator: START: obeyed\n", "step 0: at 12.50 km north, 12.50 km east, ",
                                 "is in SEARCH\n", "2.0 m/s, 50 m deep\n", "set-points taken; "}) {
    EXPECT_NE(said.find(line), std::string::npos) << line << "is not in\n" << said << earshotd_->output();
  }
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), program::kInterrupted) << earshotd_->output();
}

/// The NAMEs that a vehicle of this seed claims addresses with.
std::set<std::uint64_t> names_of(const std::string& seed, const fs::path& folder) {
  host::CanSocket bus("vcan0");
  const fs::path mission = fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/search_over_can_alone.toml";
  support::Process vehicle(kPrograms / "earshot-emulate", {"--mission", mission, "--interface", "vcan0", "--seed", seed, "--duration", "2"},
                           folder / (seed + ".txt"));
  EXPECT_EQ(vehicle.wait(60s), 0) << vehicle.output();
  std::set<std::uint64_t> names;
  for (n2k::Frame frame; bus.receive(frame) == Status::kOk;) {
    constexpr std::uint32_t kClaim = 0x18EEFF00;
    std::uint64_t name = 0;
    std::memcpy(&name, frame.data.data(), sizeof name);
    if ((frame.identifier & 0x1FFFFF00U) == kClaim) names.insert(name);
  }
  return names;
}

TEST_F(SeaOverCan, GivenOneSeedTheDevicesOfAnEmulatedVehicleHaveTheSameNamesThatAMissionMayAskFor) {
  const std::set<std::uint64_t> names = names_of("7", folder_.path());
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(names_of("7", folder_.path()), names);
  EXPECT_NE(names_of("8", folder_.path()), names);
}

TEST_F(SeaOverCan, GivenEverythingOverCanAHiddenSourceIsFoundAndTheJournalGivesEveryByteAgain) {
  std::string mission = patient_mission("search_over_can_alone.toml");
  const fs::path frozen = fs::path(EARSHOT_SOURCE_DIR) / "policy/frozen";
  start_earshotd(mission, {"--policy", frozen / "shipped.policy", "--public-key", frozen / "earshot.pub"});
  const ocean::Environment water = ocean::load_environment(fs::path(EARSHOT_SOURCE_DIR) / "sim/ocean/environments/munk_flat.toml");
  const sonar::SnrCurve curve = sonar::compute_snr_curve(water, Meters{300}, Meters{10'000});
  hil::VehicleSetup setup;
  setup.start = {.position = {Meters{12'500}, Meters{11'000}}, .depth = Meters{300}, .heading = {}, .speed = {}};
  setup.source = {.position = {Meters{12'500}, Meters{12'500}}, .snr = [&](Meters range) { return curve.at(range); }};
  setup.magnetic_field = hil::MagneticField{Radians{-0.12}};
  launch(setup);
  const hil::Operator& ashore = *vehicle_->operator_ashore();
  const auto state = [&] { return ashore.health() ? ashore.health()->health.state : MissionState::kStandby; };
  const auto nothing = [] {};
  ASSERT_TRUE(sails_until([&] { return state() == MissionState::kSearch; }, 30s, nothing)) << earshotd_->output();
  ASSERT_TRUE(sails_until([&] { return state() != MissionState::kSearch; }, 240s, nothing)) << earshotd_->output();
  const Meters found_at = vehicle_->range();
  const Meters sailed = vehicle_->sailed();
  EXPECT_EQ(state(), MissionState::kDone);
  EXPECT_EQ(ashore.health()->health.end_reason, EndReason::kCompleted);
  EXPECT_LE(found_at.value, 1000.0) << "l, of which it was outside at first";
  ASSERT_TRUE(sails_until([&] { return has_surfaced(); }, 60s, nothing)) << earshotd_->output();
  end();

  const Voyage voyage(folder_ / "journal.lcmlog");
  expect_replayed(1);
  expect_taken(voyage.setpoints);
  expect_surfaced(voyage.fixes);
  EXPECT_EQ(obeyed(ashore), (std::vector{Order::kStart, Order::kComplete}));
  EXPECT_EQ(ashore.decisions(), board::replay(folder_ / "journal.lcmlog").decisions);
  EXPECT_GT(voyage.measurements, 200U);
  std::cout << "found after " << ashore.health()->health.steps_taken << " steps and " << sailed.value << " m; " << voyage.fixes.size()
            << " fixes, " << voyage.measurements << " looks, " << voyage.setpoints.size() << " set-points, " << bus_->sent() << " frames\n";
}

}  // namespace
}  // namespace earshot
