#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "hil/nodes/bus_connection.hpp"
#include "hil/nodes/emulated_vehicle.hpp"
#include "hil/nodes/scaled_clock.hpp"
#include "tests/outage/temporary_folders_on_disk.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {

/// Seconds at sea in one of the host's.
inline constexpr double kSeaSpeed = 20.0;

/// What a journal says of a voyage.
struct Voyage {
  std::vector<messages::Navigation> fixes;
  std::vector<messages::Setpoint> setpoints;
  std::vector<messages::OperatorCommand> commands;
  std::vector<messages::CommandOutcome> answers;
  std::size_t measurements = 0;  ///< SNR

  explicit Voyage(const std::filesystem::path& journal) {
    host::JournalReader reader(journal);
    for (host::JournalRecord record; reader.next(record);) add(record);
  }

 private:
  void add(const host::JournalRecord& record) {
    messages::Input input;
    messages::Setpoint setpoint;
    command_acknowledgement_t answer{};
    if (record.channel == wire::kJournalledSetpointChannel && wire::decode(record.data, setpoint) == Status::kOk) {
      setpoints.push_back(setpoint);
    } else if (record.channel == wire::kAcknowledgementChannel && support::read_peer(record.data, answer) == Status::kOk) {
      answers.push_back(static_cast<messages::CommandOutcome>(answer.outcome));
    } else if (wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk) {
      if (const auto* fix = std::get_if<messages::Navigation>(&input.value)) fixes.push_back(*fix);
      if (const auto* command = std::get_if<messages::OperatorCommand>(&input.value)) commands.push_back(*command);
      if (std::holds_alternative<messages::SnrMeasurement>(input.value)) ++measurements;
    }
  }
};

/// earshotd at sea in a time that runs kSeaSpeed times as fast, with an emulated vehicle on vcan0, in a folder of the test's own, which
/// stays when the test fails.
class SeaOverCan : public testing::Test {
 protected:
  ~SeaOverCan() override {
    if (HasFailure()) folder_.keep();
  }

  static void replace(std::string& text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }

  /// A mission that ships, which waits longer for what is late: a machine that tests share may halt everything for a while.
  [[nodiscard]] static std::string patient_mission(const std::string& name) {
    std::string mission = support::read_text(std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions" / name);
    replace(mission, "navigation_timeout_s = 5.0", "navigation_timeout_s = 120.0");
    replace(mission, "snr_timeout_s = 5.0", "snr_timeout_s = 120.0");
    return mission;
  }

  void start_earshotd(const std::string& mission, std::vector<std::string> more) {
    std::ofstream(folder_ / "mission.toml") << mission;
    more.insert(more.end(), {folder_ / "mission.toml", "--can-interface", "vcan0", "--speed", "20", "--out", folder_.path()});
    earshotd_ = std::make_unique<support::Process>(std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd", more, folder_ / "earshotd.txt");
  }

  /// Puts the vehicle in the mission that was written.
  void launch(hil::VehicleSetup setup) {
    setup.plane = host::load_mission(folder_ / "mission.toml").plane;
    setup.utc = hil::ScaledClock::utc;
    vehicle_ = std::make_unique<hil::EmulatedVehicle>(setup);
    vehicle_->autopilot()->call_back([this](Time, const messages::Setpoint& setpoint) { taken_.push_back(setpoint); });
    bus_ = std::make_unique<hil::BusConnection>("vcan0", *vehicle_, clock_);
  }

  /// Sails until `is_true`, doing `meanwhile` at every turn. @return false when it has not come true in `patience`
  [[nodiscard]] bool sails_until(const std::function<bool()>& is_true, std::chrono::seconds patience,
                                 const std::function<void()>& meanwhile) {
    for (const auto deadline = std::chrono::steady_clock::now() + patience; std::chrono::steady_clock::now() < deadline;) {
      bus_->turn();
      meanwhile();
      if (is_true()) return true;
    }
    return false;
  }

  /// Tells earshotd to end, and takes what it still says.
  /// @param status  that it is to end with
  void end(int status_wanted = program::kDone) {
    earshotd_->signal(SIGTERM);
    int status = -1;
    EXPECT_TRUE(
        sails_until([&] { return (status = earshotd_->wait(std::chrono::milliseconds(0))) != -1; }, std::chrono::seconds(20), [] {}));
    EXPECT_EQ(status, status_wanted) << earshotd_->output();
    (void)sails_until([] { return false; }, std::chrono::seconds(1), [] {});
  }

  /// The journal gives every output again, twice alike.
  void expect_replayed(std::size_t least_decisions) const {
    const std::filesystem::path journal = folder_ / "journal.lcmlog";
    for (int i = 0; i < 2; ++i) {
      const board::ReplayResult replayed = board::replay(journal);
      EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
      EXPECT_EQ(replayed.end, host::JournalReader::End::kWhole);
      EXPECT_GE(replayed.decisions, least_decisions);
    }
  }

  /// Every set-point that was given was taken, to half of what its messages can tell apart.
  void expect_taken(const std::vector<messages::Setpoint>& given) const {
    ASSERT_EQ(taken_.size(), given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      // 1e-4 rad; and near north, what a whole turn is not a whole number of it.
      EXPECT_NEAR(wrap_to_pi(taken_[i].heading - given[i].heading).value, 0.0, 0.6e-4) << i;
      EXPECT_NEAR(taken_[i].speed.value, given[i].speed.value, 0.005 + 1e-9) << i;
      EXPECT_NEAR(taken_[i].depth.value, given[i].depth.value, 0.005 + 1e-9) << i;
    }
  }

  /// It lies still at the surface, where Earshot knows it to be.
  void expect_surfaced(const std::vector<messages::Navigation>& fixes) const {
    EXPECT_LT(vehicle_->state().speed.value, 0.01);
    EXPECT_EQ(vehicle_->state().depth.value, 0.0);
    ASSERT_FALSE(fixes.empty());
    // Half of 1e-7 degree, and what 0.01 m/s may have carried it in a fifth of a second.
    EXPECT_LT(range_between(fixes.back().position, vehicle_->state().position).value, 0.02);
    EXPECT_NEAR(fixes.back().depth.value, 0.0, 1e-4);
  }

  /// Long enough ago that its depth sensor, which speaks every two seconds, has said so.
  [[nodiscard]] bool has_surfaced() {
    if (vehicle_->state().depth.value > 0.0 || vehicle_->state().speed.value > 0.001) still_since_ = clock_.now();
    return clock_.now() - still_since_ > Duration::seconds(10);
  }

  const TemporaryFoldersOnDisk on_disk_{};
  support::TemporaryFolder folder_;
  const hil::ScaledClock clock_{kSeaSpeed};
  std::unique_ptr<hil::EmulatedVehicle> vehicle_;
  std::unique_ptr<hil::BusConnection> bus_;
  std::unique_ptr<support::Process> earshotd_;
  std::vector<messages::Setpoint> taken_;  ///< by the autopilot

 private:
  Time still_since_ = clock_.now();
};

}  // namespace earshot
