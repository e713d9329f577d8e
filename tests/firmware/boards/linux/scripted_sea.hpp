#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/port/port.hpp"

namespace earshot::board {

inline constexpr Time kUtc{1'795'000'000'000'000};  ///< when a test begins

/// A host's clocks in the test's hand.
class FakeHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return utc_; }
  [[nodiscard]] Duration monotonic() const override { return running_; }
  [[nodiscard]] Duration since_start() const { return running_ - kFirst; }
  void advance(Duration by) {
    utc_ = utc_ + by;
    running_ = running_ + by;
  }
  void set_wall_clock(Duration by) { utc_ = utc_ + by; }

 private:
  static constexpr Duration kFirst = Duration::seconds(5000);
  Time utc_ = kUtc;
  Duration running_ = kFirst;
};

/// What happens at sea, when the test said so; a port brings it.
struct Script {
  struct Event {
    Duration at;
    std::function<void(Clock&, InputSink&)> what;
    bool over = false;
  };
  std::vector<Event> events;

  void then(Duration at, std::function<void(Clock&, InputSink&)> what) { events.push_back({at, std::move(what)}); }
};

/// The clock of a mission at sea, but that waiting on it is how time passes.
class FakeClock final : public Clock {
 public:
  FakeClock(FakeHost& host, const Script& script) : host_(host), script_(script), clock_(host) {}

  [[nodiscard]] Time now() override { return clock_.now(); }
  [[nodiscard]] Time mission_time_of(Time utc) override { return clock_.mission_time_of(utc); }
  [[nodiscard]] Time arrival_of(Time utc) override { return clock_.arrival_of(utc); }
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t sent) override { return clock_.answered(outputs, sent); }

  [[nodiscard]] Wake wait(const Awaited& awaited) override {
    const Duration now = host_.since_start();
    Duration until = now + std::max(Duration{}, awaited.next_turn - clock_.now());
    for (const Script::Event& event : script_.events) {
      if (!event.over) until = std::min(until, std::max(now, event.at));
    }
    host_.advance(until - now);
    return clock_.now() >= awaited.next_turn ? Wake::kTurn : Wake::kPorts;
  }

 private:
  FakeHost& host_;
  const Script& script_;
  HostMissionClock clock_;
};

class FakePort final : public Port, public BusMember {
 public:
  FakePort(std::uint8_t index, FakeHost& host, Script& script) : Port(index, {}), host_(host), script_(script) {}

  void collect(Clock& clock, InputSink& sink) override {
    answered_at.reset();
    collected_at = host_.since_start();
    std::ranges::stable_sort(script_.events, {}, &Script::Event::at);
    for (Script::Event& event : script_.events) {
      if (event.over || event.at > host_.since_start()) continue;
      event.over = true;
      event.what(clock, sink);
    }
  }
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override {
    times.push_back(now);
    published.push_back(outputs);
    if (on_publish) on_publish();
    return 1;
  }
  void serve() override {
    ++served;
    if (!answered_at) answered_at = host_.since_start();
    if (*answered_at > collected_at) answered_late = true;
  }
  [[nodiscard]] bool settle() override { return true; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "a script"}; }
  [[nodiscard]] FurtherDuties further_duties() override { return {.bus_member = this}; }

  /// What it says of itself from now on.
  void set_report(messages::PortReport report) {
    report.port = index();
    report_ = report;
  }

  [[nodiscard]] const messages::Health& health(std::size_t turn) const { return published.at(turn).health; }
  [[nodiscard]] const messages::Health& last() const { return published.back().health; }

  std::vector<Time> times;
  std::vector<runtime::Outputs> published;
  std::function<void()> on_publish;
  std::size_t served = 0;
  std::optional<Duration> answered_at = Duration{};  ///< when it was served first since it was read
  Duration collected_at;                             ///< when it was read last
  bool answered_late = false;                        ///< ever: not at once after it was read

 private:
  FakeHost& host_;
  Script& script_;
};

}  // namespace earshot::board
