// firmware/boards/linux/connect_your_autopilot.md: its examples are the vehicle, earshotd is at sea.

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <variant>
#include <vector>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using messages::CommandOutcome;
using messages::MissionState;

const fs::path kBoard = fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux";
const fs::path kBin = EARSHOT_BIN_DIR;
constexpr std::int32_t kIssuer = 4711;

/// The test's place on the mission's LCM bus: hears what the runtime says, gives orders, and stands in for the hydrophone.
class Ashore {
 public:
  explicit Ashore(const std::string& url)
      : endpoint_(host::parse_lcm_url(url),
                  {wire::kHealthChannel, wire::kDecisionChannel, wire::kAcknowledgementChannel, wire::kSetpointChannel}) {}

  /// Listens until `is_true`, doing `meanwhile` ten times a second. @return false when it has not come true in half a minute
  [[nodiscard]] bool hears(const std::function<bool()>& is_true, const std::function<void()>& meanwhile) {
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      meanwhile();
      std::this_thread::sleep_for(100ms);
      endpoint_.collect();
      for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) note(message);
      if (is_true()) return true;
    }
    return false;
  }

  void order(std::int8_t command, std::int32_t number) {
    operator_command_t order{};
    order.utime = clock_.utc().us;
    order.expiry_utime = order.utime + 10'000'000;
    order.issuer = kIssuer;
    order.number = number;
    order.command = command;
    EXPECT_EQ(endpoint_.publish(wire::kOperatorCommandChannel, support::bytes_of(order)), Status::kOk);
  }

  void send_snr() {
    snr_estimate_t estimate{};
    estimate.utime = clock_.utc().us;
    estimate.snr_db = 3.0;
    EXPECT_EQ(endpoint_.publish(wire::kSnrEstimateChannel, support::bytes_of(estimate)), Status::kOk);
  }

  /// Of a vehicle that lies still in the middle of the mission's area.
  void send_fix() {
    nav_state_t fix{};
    fix.utime = clock_.utc().us;
    fix.north_m = fix.east_m = 12'500.0;
    EXPECT_EQ(endpoint_.publish(wire::kNavStateChannel, support::bytes_of(fix)), Status::kOk);
  }

  [[nodiscard]] MissionState state() const { return static_cast<MissionState>(health.state); }

  struct Acknowledged {
    std::int32_t number;
    CommandOutcome outcome;
  };
  health_t health{};
  std::vector<decision_t> decisions;
  int setpoints = 0;                           ///< over LCM
  std::vector<Acknowledged> acknowledgements;  ///< of this issuer

 private:
  void note(const wire::Lc02Message& message) {
    decision_t decision{};
    command_acknowledgement_t acknowledgement{};
    if (message.channel == wire::kHealthChannel) {
      EXPECT_EQ(support::read_peer(message.data, health), Status::kOk);
    } else if (message.channel == wire::kSetpointChannel) {
      ++setpoints;
    } else if (support::read_peer(message.data, decision) == Status::kOk) {
      decisions.push_back(decision);
    } else if (support::read_peer(message.data, acknowledgement) == Status::kOk && acknowledgement.issuer == kIssuer) {
      acknowledgements.push_back({.number = acknowledgement.number, .outcome = static_cast<CommandOutcome>(acknowledgement.outcome)});
    }
  }

  host::LcmEndpoint endpoint_;
  board::HostClock clock_;
};

class Autopilot : public WalkAtSea {
 protected:
  [[nodiscard]] std::unique_ptr<support::Process> python(const std::string& example, std::vector<std::string> arguments) const {
    const char* interpreter = std::getenv("EARSHOT_PYTHON");
    arguments.insert(arguments.begin(), kBoard / "examples" / (example + ".py"));
    return std::make_unique<support::Process>(interpreter == nullptr ? "" : interpreter, arguments, folder_ / (example + ".txt"));
  }

  /// Ends the search by an ABORT, the program by SIGTERM, once the vehicle had time to obey.
  void end(Ashore& ashore, const std::function<void()>& meanwhile) {
    ashore.order(operator_command_t::ABORT, 9);
    ASSERT_TRUE(ashore.hears([&] { return ashore.state() == MissionState::kAbort; }, meanwhile));
    // The set-point that says so was on its bus first; the vehicle looks for one before it sends each fix.
    const std::int64_t received = ashore.health.ports[0].received;
    ASSERT_TRUE(ashore.hears([&] { return ashore.health.ports[0].received >= received + 20; }, meanwhile));
    earshotd_->signal(SIGTERM);
    EXPECT_EQ(earshotd_->wait(20s), program::kAborted) << earshotd_->output();
    EXPECT_EQ(ashore.health.end_reason, static_cast<std::int8_t>(messages::EndReason::kOperatorAbort));
    EXPECT_GE(ashore.health.steps_taken, 3) << "a step is over only when the vehicle has sailed it";
    EXPECT_GE(ashore.decisions.size(), 4);
    ASSERT_FALSE(ashore.acknowledgements.empty());
    EXPECT_EQ(ashore.acknowledgements.back().number, 9);
    EXPECT_EQ(ashore.acknowledgements.back().outcome, CommandOutcome::kObeyed);
  }

  /// Searched at the mission's depth and speed, and came up and stopped at the end; the journal gives every byte again.
  void expect_obeyed_vehicle_in_journal() const {
    const std::vector<messages::Navigation> fixes = navigation_in_journal();
    ASSERT_FALSE(fixes.empty());
    const auto is_searching = [](const messages::Navigation& fix) {
      return std::abs(fix.depth.value - 300.0) < 1e-3 && std::abs(fix.speed.value - 20.0) < 1e-9;  // 1e-3: over CAN 0.1 Pa is 0.01 mm
    };
    EXPECT_GT(std::count_if(fixes.begin(), fixes.end(), is_searching), 10);
    EXPECT_NEAR(fixes.back().depth.value, 0.0, 1e-3);
    EXPECT_EQ(fixes.back().speed.value, 0.0);
    const board::ReplayResult replayed = board::replay(folder_ / "journal.lcmlog");
    EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
    EXPECT_EQ(replayed.end, host::JournalReader::End::kWhole);
    EXPECT_GE(replayed.decisions, 4);
  }

  [[nodiscard]] std::vector<messages::Navigation> navigation_in_journal() const {
    host::JournalReader reader(folder_ / "journal.lcmlog");
    std::vector<messages::Navigation> fixes;
    messages::Input input;
    for (host::JournalRecord record; reader.next(record);) {
      if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
      if (const auto* fix = std::get_if<messages::Navigation>(&input.value)) fixes.push_back(*fix);
    }
    return fixes;
  }
};

TEST_F(Autopilot, GivenThePageItShowsThePortsOfTheMissionThatItNames) {
  const std::string page = support::read_text(kBoard / "connect_your_autopilot.md");
  const std::string mission = support::read_text(kBoard / "missions/search_over_can.toml");
  const std::size_t begin = mission.find("\n[[port]]") + 1;
  const std::string ports = mission.substr(begin, mission.find("\n[origin]") - begin);
  EXPECT_NE(page.find("```toml\n" + ports + "```"), std::string::npos) << ports;
}

TEST_F(Autopilot, GivenThePythonExampleAsItsVehicleASearchAtSeaOverLcmIsSailedUntilAnAbort) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string url(host::kDefaultLcmUrl);
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search.toml"));
  start_earshotd({});
  const auto vehicle = python("autopilot_over_lcm", {url});
  const auto nothing = [] {};
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.port_count > 0 && ashore.health.ports[0].received > 20; }, nothing))
      << vehicle->output() << earshotd_->output();
  EXPECT_EQ(vehicle->output(), "START: OBEYED\n");
  EXPECT_EQ(ashore.state(), MissionState::kStandby) << "there is no SNR yet";
  EXPECT_EQ(ashore.setpoints, 0) << "before the search it commands nothing";

  const auto hydrophone = python("snr_over_lcm", {url, "3"});
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.steps_taken >= 3; }, nothing)) << vehicle->output() << hydrophone->output();
  EXPECT_EQ(ashore.state(), MissionState::kSearch);
  EXPECT_GT(ashore.setpoints, 0);
  end(ashore, nothing);
  expect_obeyed_vehicle_in_journal();
  EXPECT_EQ(ashore.health.navigation_refused, 0);
  EXPECT_EQ(ashore.health.snr_refused, 0);
  EXPECT_EQ(ashore.health.commands_refused, 0);
}

TEST_F(Autopilot, GivenARehearsalAtFiveTimesTheSpeedThePythonVehicleHearsTheOceanWhereItIsAndAllIsDatedByTheWallClock) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string url(host::kDefaultLcmUrl);
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search.toml"));
  std::ofstream(folder_ / "snr.csv") << "range_m,snr_db\n0,60\n10000,40\n20000,20\n";  // 2 dB a kilometre
  start_earshotd({"--speed", "5"});
  const auto vehicle = python("autopilot_over_lcm", {url, "--speed", "5"});
  const auto ocean = python("ocean_snr_over_lcm", {url, folder_ / "snr.csv", "10000", "10000"});
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.steps_taken >= 20; }, [] {})) << vehicle->output() << ocean->output();
  for (const decision_t& decision : ashore.decisions) {
    const double range_m = std::hypot(decision.north_m - 10'000.0, decision.east_m - 10'000.0);
    EXPECT_NEAR(decision.snr_db, 60.0 - 0.002 * range_m, 0.1) << "two fixes are 20 m apart, 0.04 dB";
  }
  EXPECT_EQ(ashore.health.snr_refused, 0);
  EXPECT_LE(ashore.health.utime, board::HostClock().utc().us) << "the mission's clock is ahead by four seconds for each that has passed";
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), program::kInterrupted) << earshotd_->output();
}

TEST_F(Autopilot, GivenThePythonExampleAsItsHydrophoneOnThePortThatThePageShowsItsSamplesAreHeard) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string page = support::read_text(kBoard / "connect_your_autopilot.md");
  const std::size_t begin = page.find("[[port]]\nname = \"hydrophone\"");
  ASSERT_NE(begin, std::string::npos);
  std::string mission = mission_of_short_steps("search.toml");
  replace(mission, "[origin]", page.substr(begin, page.find("```", begin) - begin) + "\n[origin]");
  write_mission(mission);
  Ashore ashore{std::string(host::kDefaultLcmUrl)};
  start_earshotd({});
  const auto hydrophone = python("sound_over_lcm", {"udpm://239.255.76.68:7668?ttl=0", "96000", "8"});
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.port_count == 2 && ashore.health.ports[1].received > 48'000; }, [] {}))
      << hydrophone->output() << earshotd_->output();
  EXPECT_EQ(ashore.health.ports[1].malformed, 0);
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), 0) << earshotd_->output();
  EXPECT_NE(earshotd_->output().find("hydrophone: of each channel "), std::string::npos) << earshotd_->output();
}

TEST_F(Autopilot, GivenThePythonExampleThatOrdersASearchIsStartedAndAbortedAndWhatIsNotObeyedIsSaid) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string url(host::kDefaultLcmUrl);
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search.toml"));
  start_earshotd({});
  const auto snr = [&] { ashore.send_snr(); };
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.port_count > 0; }, snr)) << earshotd_->output();
  const auto gives = [&](const std::string& order, int status, const std::string& says) {
    const auto operator_ = python("order_over_lcm", {url, order});
    EXPECT_EQ(operator_->wait(20s), status) << operator_->output();
    EXPECT_EQ(operator_->output(), says);
  };
  gives("COMPLETE", 1, "COMPLETE: NOT_IN_THIS_STATE\n");
  gives("START", 0, "START: OBEYED\n");
  const auto sails = [&] {
    ashore.send_snr();
    ashore.send_fix();
  };
  EXPECT_TRUE(ashore.hears([&] { return ashore.state() == MissionState::kSearch; }, sails)) << earshotd_->output();
  gives("ABORT", 0, "ABORT: OBEYED\n");
  EXPECT_TRUE(ashore.hears([&] { return ashore.state() == MissionState::kAbort; }, sails)) << earshotd_->output();
  EXPECT_EQ(ashore.health.end_reason, static_cast<std::int8_t>(messages::EndReason::kOperatorAbort));
  gives("ABORT", 0, "ABORT: REPEATED\n");
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), program::kAborted) << earshotd_->output();
}

TEST_F(Autopilot, GivenAMissionWithAKeyThePythonVehicleThatKnowsItStartsTheSearchAndOneThatDoesNotSailsOnWithoutOne) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string url(host::kDefaultLcmUrl);
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search.toml") + "\n[authority]\nkey_file = \"vehicle.key\"\n");
  std::ofstream(folder_ / "vehicle.key") << std::string(62, '0') + "2a\n";
  fs::permissions(folder_ / "vehicle.key", fs::perms::owner_read | fs::perms::owner_write);
  start_earshotd({});
  const auto snr = [&] { ashore.send_snr(); };
  {
    const auto stranger = python("autopilot_over_lcm", {url});
    ASSERT_TRUE(ashore.hears([&] { return stranger->output() == "START: NOT_VERIFIED\n"; }, snr)) << stranger->output();
    const std::int64_t received = ashore.health.ports[0].received;
    EXPECT_TRUE(ashore.hears([&] { return ashore.health.ports[0].received > received + 20; }, snr)) << stranger->output();
    EXPECT_EQ(ashore.state(), MissionState::kStandby);
  }
  const auto own = python("autopilot_over_lcm", {url, "--key-file", folder_ / "vehicle.key"});
  EXPECT_TRUE(ashore.hears([&] { return ashore.state() == MissionState::kSearch; }, snr)) << own->output() << earshotd_->output();
  EXPECT_EQ(own->output(), "START: OBEYED\n");
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), program::kInterrupted) << earshotd_->output();
  EXPECT_TRUE(support::has_line(earshotd_->output(), {"ended", "ABORT", "program", "stopped", "after"})) << earshotd_->output();
  EXPECT_EQ(earshotd_->output().find("an operator aborted it"), std::string::npos) << earshotd_->output();
}

TEST_F(Autopilot, GivenThePythonExampleThatSaysThatItLeaksARuleThatReleasesReachesThePythonVehicle) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  const std::string url(host::kDefaultLcmUrl);
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search.toml") + "\n[[rule]]\nwhen = \"leak\"\nthen = \"release\"\n");
  start_earshotd({});
  const auto snr = [&] { ashore.send_snr(); };
  const auto vehicle = python("autopilot_over_lcm", {url});
  ASSERT_TRUE(ashore.hears([&] { return ashore.state() == MissionState::kSearch; }, snr)) << vehicle->output() << earshotd_->output();
  const auto leaking = python("status_over_lcm", {url, "--leak"});
  const auto is_released = [&] { return vehicle->output() == "START: OBEYED\nreleases its drop weight\n"; };
  EXPECT_TRUE(ashore.hears(is_released, snr)) << vehicle->output() << leaking->output() << earshotd_->output();
  EXPECT_EQ(ashore.health.end_reason, static_cast<std::int8_t>(messages::EndReason::kSafetyRule));
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), program::kAborted) << earshotd_->output();
}

TEST_F(Autopilot, GivenAnOutcomeThatThePythonExamplesDoNotKnowTheySaySo) {
  const char* interpreter = std::getenv("EARSHOT_PYTHON");
  const std::string program = "import sys; sys.path.insert(0, '" + (kBoard / "examples").string() +
                              "'); from marked_order import outcome_of; print(*map(outcome_of, range(0, 15)))";
  support::Process python(interpreter == nullptr ? "" : interpreter, {"-c", program}, folder_ / "outcomes.txt");
  EXPECT_EQ(python.wait(20s), 0);
  EXPECT_TRUE(support::lines_tell(
      python.output(), {{"OBEYED", "REPEATED", "TOO_OLD", "EXPIRED", "NOT_IN_THIS_STATE", "UNKNOWN_ORDER", "NOT_CONFIGURED", "OUT_OF_ORDER",
                         "NOT_VERIFIED", "NOT_TIGHTER", "AUTOPILOT_SILENT", "OLD_MARK", "UNREADABLE", "OBEYED_NOT_DURABLE", "14", "not"}}));
  EXPECT_EQ(static_cast<int>(messages::kHighest<messages::CommandOutcome>), 13) << "the Python examples know all";
}

TEST_F(Autopilot, GivenANetworkThatComesAfterItEarshotdWaitsAndThenHearsNavigation) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo down"), 0);
  const std::string url(host::kDefaultLcmUrl);
  write_mission(mission_of_short_steps("search.toml"));
  start_earshotd({});
  for (int i = 0; i < 300 && earshotd_->output().find("journal.lcmlog") == std::string::npos; ++i) std::this_thread::sleep_for(100ms);
  EXPECT_NE(earshotd_->output().find("these links are down; tried again once a second:\n  port 1: vehicle, LCM " + url), std::string::npos)
      << earshotd_->output();
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo up; ip route add 224.0.0.0/4 dev lo"), 0);
  Ashore ashore(url);
  const auto vehicle = python("autopilot_over_lcm", {url});
  EXPECT_TRUE(ashore.hears([&] { return ashore.health.port_count > 0 && ashore.health.ports[0].received > 5; }, [] {}))
      << earshotd_->output();
  EXPECT_EQ(ashore.health.ports[0].link_up, 1);
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), 0) << earshotd_->output();
}

TEST_F(Autopilot, GivenACanInterfaceThatComesAfterItEarshotdHearsTheCppExampleOverIt) {
  const std::string url = "udpm://239.255.76.67:27498?ttl=0";
  const auto ip = [](const std::string& what) { return std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link " + what).c_str()); };
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search_over_can.toml"));
  start_earshotd({"--lcm-url", url, "--can-interface", "vcan79"});
  const auto nothing = [] {};
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.port_count > 0; }, nothing)) << earshotd_->output();
  EXPECT_EQ(ashore.health.ports[0].link_up, 0);
  ASSERT_EQ(ip("add vcan79 type vcan"), 0);
  ASSERT_EQ(ip("set vcan79 up"), 0);
  support::Process vehicle(kBin / "autopilot_over_can", {"vcan79"}, folder_ / "vehicle.txt");
  EXPECT_TRUE(ashore.hears([&] { return ashore.health.ports[0].received > 5; }, nothing)) << vehicle.output() << earshotd_->output();
  EXPECT_EQ(ashore.health.ports[0].link_up, 1);
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(20s), 0) << earshotd_->output();
  ASSERT_EQ(ip("del vcan79"), 0);
}

TEST_F(Autopilot, GivenTheCppExampleAsItsVehicleASearchOverCanWithTheRestOverLcmIsSailedAndItsJournalGivesEveryByteAgain) {
  const std::string url = "udpm://239.255.76.67:27499?ttl=0";  // beyond those of flights and other tests
  Ashore ashore(url);
  write_mission(mission_of_short_steps("search_over_can.toml"));
  start_earshotd({"--lcm-url", url, "--can-interface", "vcan0"});
  support::Process vehicle(kBin / "autopilot_over_can", {"vcan0"}, folder_ / "vehicle.txt");
  const auto hydrophone = [&] { ashore.send_snr(); };
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.port_count > 0 && ashore.health.ports[0].received > 5; }, hydrophone))
      << vehicle.output() << earshotd_->output();
  EXPECT_EQ(ashore.state(), MissionState::kStandby);

  ashore.order(operator_command_t::COMPLETE, 1);
  ashore.order(operator_command_t::START, 2);
  ASSERT_TRUE(ashore.hears([&] { return ashore.health.steps_taken >= 3; }, hydrophone)) << vehicle.output() << earshotd_->output();
  ASSERT_EQ(ashore.acknowledgements.size(), 2);
  EXPECT_EQ(ashore.acknowledgements[0].outcome, CommandOutcome::kNotInThisState) << "COMPLETE in STANDBY";
  EXPECT_EQ(ashore.acknowledgements[1].outcome, CommandOutcome::kObeyed);
  EXPECT_EQ(ashore.state(), MissionState::kSearch);
  end(ashore, hydrophone);
  expect_obeyed_vehicle_in_journal();
  EXPECT_EQ(ashore.health.navigation_refused, 0);
  EXPECT_EQ(ashore.health.snr_refused, 0);
  EXPECT_EQ(ashore.health.commands_refused, 1);
}

}  // namespace
}  // namespace earshot
