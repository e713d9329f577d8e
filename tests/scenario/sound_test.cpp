// A hydrophone of 96 kHz x 8 channels beside a mission at sea. EARSHOT_SOUND_SECONDS says how long it sends; 5 without.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "earshot/health_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kMissions = fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions";
const std::string kSoundUrl = "udpm://239.255.76.68:7668?ttl=0";
const std::string kHydrophone = "[[port]]\nname = \"ears\"\nkind = \"lcm\"\nurl = \"" + kSoundUrl + "\"\nroles = [\"hydrophone\"]\n\n";
/// Integration times so short that the noise is known and measurements come within seconds.
const std::string kHearing =
    "[hydrophone]\npreset = \"fin_whale\"\nsensitivity_db_re_1v_per_upa = -170.0\nfull_scale_v = 1.0\nadc_bits = 24\n"
    "integration_time_s = 0.2\nfloor_window_s = 3.2\n\n";
constexpr std::uint8_t kSoundPort = 2;

std::chrono::milliseconds sound_duration() {
  const char* const seconds = std::getenv("EARSHOT_SOUND_SECONDS");
  return std::chrono::seconds(seconds == nullptr ? 5 : std::atoi(seconds));
}

std::chrono::duration<double> processor_time_of_children() {
  rusage usage{};
  (void)::getrusage(RUSAGE_CHILDREN, &usage);
  const auto of = [](const timeval& time) {
    return std::chrono::duration<double>(static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec));
  };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

class Sound : public testing::Test {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(support::random_walk_policy()));
    support::write_public_key(folder_ / "walk.pub");
    shore_ =
        std::make_unique<host::LcmEndpoint>(host::parse_lcm_url(host::kDefaultLcmUrl), std::vector<std::string_view>{wire::kHealthChannel});
  }
  void TearDown() override {
    if (HasFailure()) folder_.keep();
  }

  void start_earshotd_with_hydrophone() {
    std::string mission = support::read_text(kMissions / "fixed_source.toml");
    mission.insert(mission.find("[origin]"), kHydrophone + kHearing);
    mission.replace(mission.find("step_period_s = 1.0"), 19, "step_period_s = 0.1");
    mission.replace(mission.find("\"snr\", "), 7, "");
    std::ofstream(folder_ / "mission.toml") << mission;
    std::vector<std::string> arguments{folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key",
                                       folder_ / "walk.pub",     "--out",    folder_.path()};
    if (host::kHeapTrapCounts) arguments.emplace_back("--prove-no-alloc");  // of every thread: its exit status says so
    earshotd_ = std::make_unique<support::Process>(fs::path(EARSHOT_BIN_DIR) / "earshotd", arguments, folder_ / "earshotd.txt");
  }

  /// Listens ashore until it is true of the runtime's health. @return false when it has not come true in so long
  bool hears(const std::function<bool(const health_t&)>& is_true, std::chrono::milliseconds patience = 30s) {
    for (const auto deadline = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < deadline;) {
      std::this_thread::sleep_for(20ms);
      shore_->collect();
      for (wire::Lc02Message message; shore_->take(message) == Status::kOk;) {
        health_t health{};
        if (support::read_peer(message.data, health) == Status::kOk && is_true(health)) return true;
      }
    }
    return false;
  }

  /// Until health accounts for every sample that the driver's ADC took; what was lost last shows only when another block comes.
  bool accounts_for_all(support::HydrophoneDriver& driver) {
    const auto is_accounted = [&](const health_t& health) {
      for (const port_report_t& port : health.ports) {
        if (port.port == kSoundPort) return static_cast<std::uint64_t>(port.received + port.lost) == driver.taken();
      }
      return false;
    };
    for (int i = 0; i < 15; ++i) {
      (void)driver.send();
      if (hears(is_accounted, 2s)) return true;
    }
    return false;
  }

  void order_abort() {
    operator_command_t order{};
    order.utime = board::HostClock().utc().us;
    order.command = operator_command_t::ABORT;
    EXPECT_EQ(shore_->publish(wire::kOperatorCommandChannel, support::bytes_of(order)), Status::kOk);
  }

  /// What the hydrophone's port brought, by the journal.
  struct Heard {
    messages::PortReport report;  ///< the last
    std::uint64_t measurements = 0;
  };
  [[nodiscard]] Heard heard_by_journal() const {
    host::JournalReader reader(folder_ / "journal.lcmlog");
    Heard heard;
    messages::Input input;
    for (host::JournalRecord record; reader.next(record);) {
      EXPECT_NE(record.channel, wire::kHydrophoneBlockChannel);
      if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
      const auto* report = std::get_if<messages::PortReport>(&input.value);
      if (report != nullptr && report->port == kSoundPort) heard.report = *report;
      if (std::holds_alternative<messages::SnrMeasurement>(input.value) && input.port == kSoundPort) ++heard.measurements;
    }
    return heard;
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<host::LcmEndpoint> shore_;
  std::unique_ptr<support::Process> earshotd_;
};

TEST_F(Sound, GivenEightChannelsAtNinetySixKilohertzEverySampleIsHeardOrCountedAndAnAbortIsObeyedMeanwhile) {
  start_earshotd_with_hydrophone();
  ASSERT_TRUE(hears([](const health_t& health) { return health.port_count == 2; })) << earshotd_->output();
  support::HydrophoneDriver driver(kSoundUrl, {});
  driver.block().utime = board::HostClock().utc().us;
  const auto began = std::chrono::steady_clock::now();
  driver.send_in_time_for(sound_duration() / 2);
  order_abort();
  driver.send_in_time_for(sound_duration() / 2);
  const std::chrono::duration<double> sent_for = std::chrono::steady_clock::now() - began;
  ASSERT_TRUE(accounts_for_all(driver)) << earshotd_->output();
  ASSERT_TRUE(hears([](const health_t& health) { return health.state == health_t::ABORT; }));
  earshotd_->signal(SIGTERM);
  ASSERT_EQ(earshotd_->wait(30s), program::kAborted) << earshotd_->output();

  const auto [report, measurements] = heard_by_journal();
  EXPECT_EQ(report.received + report.lost, driver.taken());
  EXPECT_EQ(report.malformed, 0U);
  EXPECT_GT(measurements, 0U) << earshotd_->output();
  EXPECT_TRUE(board::replay(folder_ / "journal.lcmlog").is_same());
  EXPECT_LT(fs::file_size(folder_ / "journal.lcmlog"), driver.taken()) << "a byte a sample of one channel of eight, where a sample is four";
  std::cout << sent_for.count() << " s of 96 kHz x 8 channels: " << report.received << " samples of each channel heard, " << report.lost
            << " lost, " << measurements << " looks; earshotd took " << 100.0 * processor_time_of_children() / sent_for
            << " % of a processor\n";
}

TEST_F(Sound, GivenAHydrophoneThatNobodyListensToAndNobodyWhoBringsAnSnrAMissionIsRefused) {
  std::string mission = support::read_text(kMissions / "fixed_source.toml");
  mission.insert(mission.find("[origin]"), kHydrophone);
  mission.replace(mission.find("\"snr\", "), 7, "");
  std::ofstream(folder_ / "mission.toml") << mission;
  support::Process earshotd(
      fs::path(EARSHOT_BIN_DIR) / "earshotd",
      {folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub", "--out", folder_.path()},
      folder_ / "earshotd.txt");
  EXPECT_EQ(earshotd.wait(30s), 2);
  EXPECT_TRUE(support::has_line(earshotd.output(), {"port", "SNR", "role \"snr\""})) << earshotd.output();
  EXPECT_FALSE(fs::exists(folder_ / "journal.lcmlog"));
}

TEST_F(Sound, GivenAMissionWithoutAHydrophoneNobodyCanFlyItBySimulatedSoundNorAtSeaWithHear) {
  const auto said = [&](std::vector<std::string> arguments) {
    support::Process earshotd(fs::path(EARSHOT_BIN_DIR) / "earshotd", std::move(arguments), folder_ / "earshotd.txt");
    EXPECT_EQ(earshotd.wait(30s), 2);
    return earshotd.output();
  };
  const std::string mission = kMissions / "fixed_source.toml";
  const std::string without = said({mission, "--simulation", "77", "--hear", "--out", folder_.path()});
  EXPECT_NE(without.find("no port has the role \"hydrophone\""), std::string::npos) << without;
  const std::string at_sea = said({mission, "--hear", "--out", folder_.path()});
  EXPECT_NE(at_sea.find("--hear: only with --simulation"), std::string::npos) << at_sea;
}

}  // namespace
}  // namespace earshot
