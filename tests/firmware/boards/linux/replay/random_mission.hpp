#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/replay/resume.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "firmware/host/journal/journal.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::board {

/// Says of itself, and sends, what a test wants.
class ReportingPort final : public Port {
 public:
  explicit ReportingPort(std::uint8_t index) : Port(index, {host::Role::kAutopilot}) {}
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& outputs) override { return outputs.setpoint && can_send ? 1 : 0; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "a script"}; }
  void lose(std::uint64_t count) { report_.lost += count; }

  bool can_send = true;
};

inline const policy::FrozenPolicy& walk() {
  static const policy::FrozenPolicy policy = support::random_walk_policy();
  return policy;
}

inline const std::vector<std::uint8_t>& walk_bytes() {
  static const std::vector<std::uint8_t> bytes = support::signed_bytes(walk());
  return bytes;
}

inline config::Mission walking_mission(std::uint64_t seed) {
  config::Mission mission = runtime::paper_mission();
  mission.operating_area = {.south_west = {}, .north_east = walk().area_size};
  mission.step_length = walk().step_length;
  mission.detection_threshold = walk().detection_threshold;
  mission.max_steps = 5;
  mission.action_seed = seed;
  return mission;
}

/// Something that happens to a mission: an input, messages that a port loses, or a turn.
struct Happening {
  Time time;
  std::uint8_t port = 0;
  std::optional<InputSink::Value> input = std::nullopt;
  std::uint64_t lost = 0;

  [[nodiscard]] bool is_turn() const { return !input && lost == 0; }
};

/// Whatever a random number generator makes: good data and bad, any date, any order, any bits.
class RandomScript {
 public:
  explicit RandomScript(std::uint64_t seed) : random_(seed), mission_(walking_mission(seed)) {}

  std::vector<Happening> turns(int count) {
    std::vector<Happening> happenings;
    for (int i = 0; i < count; ++i) {
      for (std::uint32_t inputs = below(6); inputs > 0; --inputs) happenings.push_back(input());
      if (below(10) == 0) happenings.push_back({.time = time_, .lost = 1 + below(100)});
      pass(2'000'000);
      happenings.push_back({.time = time_});
    }
    return happenings;
  }

 private:
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(random_.uniform_float() * static_cast<float>(bound)); }
  void pass(std::uint32_t most_us) { time_ = time_ + Duration{static_cast<std::int64_t>(below(most_us))}; }

  double any_double() {
    return std::bit_cast<double>((std::uint64_t{below(0x10000)} << 48U) | (std::uint64_t{below(0x10000)} << 32U) | below(0xFFFFFF));
  }

  double within(double low, double high) {
    if (below(20) == 0) return any_double();
    return low + (high - low) * static_cast<double>(random_.uniform_float());
  }

  Time date() {
    if (below(20) == 0) return Time{std::bit_cast<std::int64_t>(any_double())};
    return time_ + Duration{static_cast<std::int64_t>(below(4'000'000)) - 3'000'000};
  }

  Happening input() {
    pass(100'000);
    const auto port = static_cast<std::uint8_t>(1 + below(config::kMaxPorts - 1));
    switch (below(8)) {
      case 0:
        // START more often than what ends a search, or hardly any would be under way.
        return {.time = time_,
                .port = port,
                .input = messages::OperatorCommand{.time = date(),
                                                   .expiry = date(),
                                                   .issuer = below(10),
                                                   .number = ++commands_ - below(3),
                                                   .order = static_cast<messages::Order>(below(12) == 0 ? below(256) : 1)}};
      case 1:
      case 2:
        return {.time = time_,
                .port = port,
                .input = messages::SnrMeasurement{.time = date(), .snr = Decibels{within(-30, 60)}, .too_faint = below(3) == 0}};
      default:
        position_ = position_ + at(within(-300, 300), within(-300, 300));
        if (!mission_.operating_area.contains(position_)) position_ = at(12'000, 12'000);
        return {.time = time_,
                .port = port,
                .input = messages::Navigation{.time = date(),
                                              .position = position_,
                                              .depth = Meters{within(0, 400)},
                                              .heading = Radians{within(-4, 4)},
                                              .speed = MetersPerSecond{within(0, 3)}}};
    }
  }

  Pcg32 random_;
  config::Mission mission_;
  Time time_{1'795'000'000'000'000};
  NorthEast position_ = at(12'000, 12'000);
  std::uint32_t commands_ = 3;
};

/// A vehicle to which a script happens.
class Vessel {
 public:
  /// A new mission.
  Vessel(const config::Mission& mission, const std::filesystem::path& path)
      : Vessel(configured(mission), host::JournalFile(path, host::ExistingJournal::kReplace), 0) {
    turn_.record_mission(mission, {.policy = walk_bytes(), .tables = {}, .build = "of a test"});
  }
  /// One that goes on.
  Vessel(Resumption before, const std::filesystem::path& path)
      : Vessel(std::move(before.runtime), cut(path, before.kept_bytes), before.next_number) {
    ports_.count_on_from(before.memory.reports);
    turn_.go_on_after(before, "of a test");
  }

  void live_through(std::span<const Happening> script) {
    for (const Happening& happening : script) {
      clock_.time = happening.time;
      if (happening.input) turn_.take(happening.port, *happening.input);
      if (happening.lost > 0) port_->lose(happening.lost);
      if (happening.is_turn()) decisions_ += turn_().decision ? 1U : 0U;
    }
  }

  /// From now on no set-point leaves.
  void mute() { port_->can_send = false; }

  /// How the mission stands.
  [[nodiscard]] messages::ClosingRecord standing() const {
    return closing_record_of({.end = LoopEnd::kMissionOver, .last = turn_.outputs(), .began = {}, .time = turn_.last()});
  }
  /// Closes the journal.
  void end(const std::optional<messages::ClosingRecord>& closing = std::nullopt) {
    if (closing) journal_.conclude(*closing);
    EXPECT_EQ(journal_.close(), Status::kOk);
  }

 private:
  Vessel(std::unique_ptr<runtime::Runtime> runtime, host::JournalFile file, std::uint32_t next_number)
      : runtime_(std::move(runtime)), journal_(std::move(file), next_number) {
    auto port = std::make_unique<ReportingPort>(ports_.next_index());
    port_ = port.get();
    ports_.add(std::move(port));
    clock_.time = Time{1'795'000'000'000'000};
  }
  static std::unique_ptr<runtime::Runtime> configured(const config::Mission& mission) {
    auto runtime = std::make_unique<runtime::Runtime>();
    EXPECT_EQ(runtime->configure(mission, walk(), {}), Status::kOk);
    return runtime;
  }
  static host::JournalFile cut(const std::filesystem::path& path, std::uint64_t bytes) {
    host::JournalFile file(path, host::ExistingJournal::kGoOn);
    file.cut(bytes);
    return file;
  }

  SetClock clock_;
  PortSet ports_;
  ReportingPort* port_ = nullptr;  ///< of ports_
  std::unique_ptr<runtime::Runtime> runtime_;
  host::Journal journal_;
  OwnCore core_{*runtime_};
  MissionTurn turn_{core_, ports_, journal_, clock_};
  std::size_t decisions_ = 0;
};

/// A mission of `turns` turns that a random script happens to.
inline void fly_random_mission(std::uint64_t seed, const std::filesystem::path& path, int turns,
                               const std::optional<messages::ClosingRecord>& closing = std::nullopt) {
  Vessel vessel(walking_mission(seed), path);
  vessel.live_through(RandomScript(seed).turns(turns));
  vessel.end(closing);
}

}  // namespace earshot::board
