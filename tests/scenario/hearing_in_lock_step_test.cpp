// The vehicle hears a simulator's sound: a tick, its fix and its blocks, again and again, as sim/link/README.md says.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "sim/link/run_slot.hpp"
#include "sim/link/simulator_end.hpp"
#include "tests/support/gaussian_noise.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr int kTicks = 60;
constexpr int kCallBegins = 50;  ///< s
constexpr int kBlocksPerTick = 10;

/// The shipped mission that hears, without what it says of the policy's window, so that a random walk can fly it.
void write_mission(const fs::path& path) {
  std::string text = support::read_text(fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/hear_at_sea.toml");
  const std::size_t begin = text.find("listening = ");
  text.erase(begin, text.find("\n\n", begin) - begin);
  support::write_bytes(path, {text.begin(), text.end()});
}

/// A second of a sea of 90 dB in the band, with a tone 12 dB louder from kCallBegins on, in ten blocks.
class Sea {
 public:
  explicit Sea(const std::string& url) : driver_(url, {.sample_rate_hz = 1000, .channels = 1, .samples_per_block = 1000 / kBlocksPerTick}) {
    driver_.block().utime = 0;
    driver_.block().gain_db = 0;
  }
  void sound_for_a_second() {
    for (int block = 0; block < kBlocksPerTick; ++block) {
      for (float& sample : driver_.block().samples) {
        const double t = static_cast<double>(sample_++) / 1000.0;
        const double tone = t < kCallBegins ? 0.0 : amplitude_of(102.0) * std::sqrt(2.0) * std::sin(2.0 * std::numbers::pi * 20.0 * t);
        sample = static_cast<float>(amplitude_of(90.0) * std::sqrt(500.0 / 15.0) * double{noise_()} + tone);
      }
      ASSERT_TRUE(driver_.send());
    }
  }

 private:
  /// A level's share of full scale: 176 dB re 1 uPa, by the mission's 2 V and -170 dB re 1 V/uPa.
  static double amplitude_of(double level_db) { return std::pow(10.0, (level_db - 176.0206) / 20.0); }

  support::HydrophoneDriver driver_;
  support::GaussianNoise noise_{5};
  std::int64_t sample_ = 0;
};

/// Flies kTicks seconds and ends with an ABORT; START is said when the noise is known.
void fly(const support::TemporaryFolder& folder) {
  support::write_bytes(folder / "walk.policy", support::signed_bytes(support::random_walk_policy()));
  support::write_public_key(folder / "walk.pub");
  write_mission(folder / "mission.toml");
  const link::RunSlot slot;
  const link::RunId run = link::new_run();
  support::Process earshotd(fs::path(EARSHOT_BIN_DIR) / "earshotd",
                            {folder / "mission.toml", "--policy", folder / "walk.policy", "--public-key", folder / "walk.pub", "--out",
                             folder.path(), "--simulation", std::to_string(slot.domain()), "--run", std::to_string(run), "--hear",
                             "--lcm-url", slot.lcm_url(), "--hydrophone-url", slot.hydrophone_url()},
                            folder / "earshotd.txt");
  link::SimulatorEnd simulator(slot.domain(), run);
  host::LcmEndpoint bus(host::parse_lcm_url(slot.lcm_url()), {});
  Sea sea(slot.hydrophone_url());
  ASSERT_TRUE(simulator.wait_for_runtime(30s)) << earshotd.output();
  for (int tick = 1; tick <= kTicks; ++tick) {
    const Time now{std::int64_t{tick} * 1'000'000};
    const messages::Navigation fix{.time = now,
                                   .position = {Meters{12'500 + 2.0 * tick}, Meters{12'500}},
                                   .depth = Meters{300},
                                   .heading = Radians{0},
                                   .speed = MetersPerSecond{2}};
    ASSERT_EQ(bus.publish(wire::kNavStateChannel, wire::Encoded(fix).bytes()), Status::kOk);
    sea.sound_for_a_second();
    const messages::Order order = tick == kTicks ? messages::Order::kAbort : messages::Order::kStart;
    const auto number = static_cast<std::uint64_t>(tick);
    simulator.send({.number = number,
                    .time = now,
                    .navigation_messages = number,
                    .hydrophone_blocks = number * kBlocksPerTick,
                    .snr = std::nullopt,
                    .command = tick == kTicks || tick == 45 ? static_cast<std::uint8_t>(order) : std::uint8_t{0}});
    link::Answer answer;
    do {
      ASSERT_EQ(simulator.receive(answer, 10s), link::Delivery::kArrived) << "tick " << tick << "\n" << earshotd.output();
    } while (answer.number != number);  // those to knocks
  }
  ASSERT_EQ(earshotd.wait(30s), program::kAborted) << earshotd.output();
}

std::vector<messages::SnrMeasurement> measurements_in(const fs::path& journal) {
  std::vector<messages::SnrMeasurement> measurements;
  host::JournalReader reader(journal);
  messages::Input input;
  for (host::JournalRecord record; reader.next(record);) {
    if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
    if (const auto* measurement = std::get_if<messages::SnrMeasurement>(&input.value)) measurements.push_back(*measurement);
  }
  return measurements;
}

TEST(HearingInLockStep, GivenASimulatorsSoundTheVehicleSearchesByWhatItMeasuresAndTwiceTheSameToTheByte) {
  const support::TemporaryFolder first;
  const support::TemporaryFolder second;
  ASSERT_NO_FATAL_FAILURE(fly(first));
  ASSERT_NO_FATAL_FAILURE(fly(second));
  const fs::path journal = first / "journal.lcmlog";
  EXPECT_EQ(support::read_text(journal), support::read_text(second / "journal.lcmlog"));
  const board::ReplayResult replayed = board::replay(journal);
  EXPECT_TRUE(replayed.is_same());
  EXPECT_GE(replayed.decisions, 1U) << "the search began";

  double sum_db = 0.0;
  int in_call = 0;
  for (const messages::SnrMeasurement& measurement : measurements_in(journal)) {
    if (measurement.time.us < (kCallBegins + 1) * std::int64_t{1'000'000}) continue;
    EXPECT_FALSE(measurement.too_faint);
    sum_db += measurement.snr.value;
    ++in_call;
  }
  ASSERT_GE(in_call, 7);
  EXPECT_NEAR(sum_db / in_call, 12.0, 0.6) << "eight looks scatter by 0.14 dB, the floor of so short a memory by 0.4";
}

}  // namespace
}  // namespace earshot
