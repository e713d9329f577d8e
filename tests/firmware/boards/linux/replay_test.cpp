#include "firmware/boards/linux/replay.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/port_set.hpp"
#include "firmware/core/random.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;

/// Says of itself whatever a test wants.
class ReportingPort final : public Port {
 public:
  explicit ReportingPort(std::uint8_t index) : Port(index, {}) {}
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override { return 0; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] std::string description() const override { return "a script"; }
  void lose(std::uint64_t count) { report_.lost += count; }
};

const policy::FrozenPolicy& walk() {
  static const policy::FrozenPolicy policy = support::random_walk_policy();
  return policy;
}

const std::vector<std::uint8_t>& walk_bytes() {
  static const std::vector<std::uint8_t> bytes = support::signed_bytes(walk());
  return bytes;
}

/// A runtime that is given whatever a random number generator makes: good data and bad, any date, any order, any bits.
class RandomMission {
 public:
  RandomMission(std::uint64_t seed, const fs::path& path) : random_(seed), journal_(path, {.existing = host::ExistingJournal::kReplace}) {
    mission_ = runtime::paper_mission();
    mission_.operating_area = {.south_west = {}, .north_east = walk().area_size};
    mission_.step_length = walk().step_length;
    mission_.detection_threshold = walk().detection_threshold;
    mission_.max_steps = 5;
    mission_.action_seed = seed;
    EXPECT_EQ(runtime_->configure(mission_, walk()), Status::kOk);
    auto port = std::make_unique<ReportingPort>(ports_.next_index());
    port_ = port.get();
    ports_.add(std::move(port));
  }

  void fly(int turns, const std::optional<wire::ClosingRecord>& closing = std::nullopt) {
    turn_.record_mission(mission_, walk_bytes(), "of a test");
    for (int i = 0; i < turns; ++i) {
      for (std::uint32_t inputs = below(6); inputs > 0; --inputs) input();
      if (below(10) == 0) port_->lose(below(100));
      clock_.time = clock_.time + Duration{static_cast<std::int64_t>(below(2'000'000))};
      (void)turn_();
    }
    if (closing) journal_.conclude(*closing);
    EXPECT_EQ(journal_.close(), Status::kOk);
  }

 private:
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_.uniform_float() * static_cast<float>(bound)); }

  double any_double() {
    return std::bit_cast<double>((std::uint64_t{below(0x10000)} << 48U) | (std::uint64_t{below(0x10000)} << 32U) | below(0xFFFFFF));
  }

  double within(double low, double high) {
    if (below(20) == 0) return any_double();
    return low + (high - low) * static_cast<double>(random_.uniform_float());
  }

  Time date() {
    if (below(20) == 0) return Time{std::bit_cast<std::int64_t>(any_double())};
    return clock_.time + Duration{static_cast<std::int64_t>(below(4'000'000)) - 3'000'000};
  }

  void input() {
    clock_.time = clock_.time + Duration{static_cast<std::int64_t>(below(100'000))};
    const auto port = static_cast<std::uint8_t>(below(config::kMaxPorts));
    switch (below(8)) {
      case 0:
        // START more often than what ends a search, or hardly any would be under way.
        turn_.take(port, messages::OperatorCommand{.time = date(),
                                                   .expiry = date(),
                                                   .issuer = below(10),
                                                   .number = ++commands_ - below(3),
                                                   .order = static_cast<messages::Order>(below(12) == 0 ? below(256) : 1)});
        break;
      case 1:
      case 2:
        turn_.take(port, messages::SnrMeasurement{.time = date(), .snr = Decibels{within(-30, 60)}, .too_faint = below(3) == 0});
        break;
      default:
        position_ = position_ + runtime::at(within(-300, 300), within(-300, 300));
        if (!mission_.operating_area.contains(position_)) position_ = runtime::at(12'000, 12'000);
        turn_.take(port, messages::Navigation{.time = date(),
                                              .position = position_,
                                              .depth = Meters{within(0, 400)},
                                              .heading = Radians{within(-4, 4)},
                                              .speed = MetersPerSecond{within(0, 3)}});
    }
  }

  Pcg32 random_;
  SetClock clock_;
  PortSet ports_;
  ReportingPort* port_ = nullptr;  ///< of ports_
  host::Journal journal_;
  config::Mission mission_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  MissionTurn turn_{*runtime_, ports_, journal_, clock_};
  NorthEast position_ = runtime::at(12'000, 12'000);
  std::uint32_t commands_ = 3;
};

class Replay : public testing::Test {
 protected:
  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal";
};

TEST_F(Replay, GivesEveryByteOfTenThousandJournalsOfRandomInputsAgain) {
  std::size_t decisions = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    RandomMission(seed, path_).fly(30);
    const ReplayResult result = replay(path_);
    ASSERT_TRUE(result.is_same()) << "seed " << seed << ", record " << (result.difference ? result.difference->record : *result.gap);
    ASSERT_EQ(result.turns, 30U) << "seed " << seed;
    decisions += result.decisions;
  }
  EXPECT_GT(decisions, 1000U) << "most missions never began to search";
}

TEST_F(Replay, FindsTheOutputInWhichOneBitDiffers) {
  RandomMission(1, path_).fly(30);
  // The last record is a health record: its byte of the mission's state follows header (28), channel (14), fingerprint (8) and date (8).
  host::JournalReader reader(path_);
  std::size_t last = 0;
  std::uint32_t number = 0;
  for (host::JournalRecord record;;) {
    const std::size_t begins = reader.offset();
    if (!reader.next(record)) break;
    last = begins;
    number = record.number;
  }
  const fs::path forged = path_.string() + "-forged";
  host::Journal journal(forged, {.existing = host::ExistingJournal::kReplace});
  host::JournalReader again(path_);
  for (host::JournalRecord record; again.next(record);) {
    if (record.number == number) record.data[16] ^= 1U;
    ASSERT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
  }
  ASSERT_EQ(journal.close(), Status::kOk);
  const ReplayResult result = replay(forged);
  fs::remove(forged);
  ASSERT_TRUE(result.difference) << last;
  EXPECT_EQ(result.difference->record, number);
  EXPECT_EQ(result.difference->channel, "EARSHOT_HEALTH");
}

TEST_F(Replay, TellsAJournalThatWasEndedInOrderFromOneWhoseEndIsMissing) {
  RandomMission flight(1, path_);
  const wire::ClosingRecord said{.time = Time{7}, .ending = wire::Ending::kMissionOver, .steps_taken = 5};
  flight.fly(30, said);
  const ReplayResult whole = replay(path_);
  EXPECT_TRUE(whole.is_same());
  EXPECT_EQ(whole.closing, said);
  fs::resize_file(path_, fs::file_size(path_) - 94);  // 28 + 19 + 47: as if it had been killed
  const ReplayResult killed = replay(path_);
  EXPECT_TRUE(killed.is_same());
  EXPECT_EQ(killed.end, host::JournalReader::End::kWhole);
  EXPECT_EQ(killed.turns, whole.turns);
  EXPECT_FALSE(killed.closing);
}

TEST_F(Replay, FindsRecordsThatAreMissingAtTheEndByTheNumberOfTheClosingRecord) {
  RandomMission(1, path_).fly(30, wire::ClosingRecord{});
  std::vector<std::uint64_t> begins;
  host::JournalReader reader(path_);
  for (host::JournalRecord record;;) {
    begins.push_back(reader.offset());
    if (!reader.next(record)) break;
  }
  const std::uint64_t closing = begins[begins.size() - 2];
  const std::uint64_t last_turn = begins[begins.size() - 3];
  std::ifstream file(path_, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(last_turn), bytes.begin() + static_cast<std::ptrdiff_t>(closing));
  support::write_bytes(path_, bytes);
  const ReplayResult result = replay(path_);
  EXPECT_EQ(result.gap, begins.size() - 3);
  EXPECT_TRUE(result.closing);
}

TEST_F(Replay, RefusesAJournalThatDoesNotBeginWithItsMission) {
  {
    host::Journal journal(path_, {.existing = host::ExistingJournal::kReplace});
    ASSERT_EQ(journal.append(Time{1}, "EARSHOT_HEALTH", std::array<std::uint8_t, 3>{1, 2, 3}), Status::kOk);
  }
  EXPECT_THROW((void)replay(path_), host::BadInput);
}

}  // namespace
}  // namespace earshot::board
