#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string_view>

#include "firmware/host/journal/journal.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::journal {

/// 2026-11-22 15:04:00 UTC (GNU date).
inline constexpr Time kBegan{1'795'359'840'000'000};

inline Time after(std::int64_t milliseconds) {
  return kBegan + Duration::milliseconds(milliseconds);
}

/// A journal that tests write record by record.
class WrittenJournal {
 public:
  explicit WrittenJournal(const std::filesystem::path& path) : journal_(path, {.existing = host::ExistingJournal::kReplace}) {}

  template <class Message>
  void message(Time time, std::string_view channel, const Message& message) {
    bytes(time, channel, wire::Encoded(message, time).bytes());
  }
  void bytes(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
    if (journal_.append(time, channel, data, host::Priority::kOrder) != Status::kOk) throw std::runtime_error("not appended");
  }
  template <class Value>
  void input(Time time, std::uint8_t port, const Value& value) {
    const wire::InputRecord record(messages::Input{.arrival = time, .port = port, .sequence = 0, .value = value});
    bytes(time, record.channel(), record.data());
  }
  void health(Time time, std::int64_t turn, messages::MissionState state, messages::EndReason reason = messages::EndReason::kNone,
              std::uint32_t steps = 0) {
    messages::Health health;
    health.turn = static_cast<std::uint64_t>(turn);
    health.state = state;
    health.end_reason = reason;
    health.steps_taken = steps;
    message(time, wire::kHealthChannel, health);
  }
  void close() {
    if (journal_.close() != Status::kOk) throw std::runtime_error("not closed");
  }
  void close(const messages::ClosingRecord& closing) {
    journal_.conclude(closing);
    close();
  }
  void flush() {
    if (journal_.flush() != Status::kOk) throw std::runtime_error("not written");
  }

 private:
  host::Journal journal_;
};

inline constexpr std::array<std::uint8_t, 3> kPolicy{1, 2, 3};
inline constexpr std::uint32_t kPolicyCrc = 0x55BC801D;  ///< of these bytes (Python's zlib)

inline messages::MissionRecord known_mission() {
  config::Mission mission;
  mission.operating_area = {.south_west = at(0, 0), .north_east = at(25'000, 20'000)};
  mission.search_depth = Meters{300};
  mission.max_depth = Meters{400};
  mission.search_speed = MetersPerSecond{2};
  mission.step_length = Meters{1000};
  mission.max_steps = 100;
  mission.max_time = Duration::seconds(60'000);
  mission.detection_threshold = Decibels{10};
  messages::MissionRecord record{.mission = mission, .policy_crc32 = kPolicyCrc};
  constexpr std::string_view kBuild = "0.1.0 abc";
  std::copy(kBuild.begin(), kBuild.end(), record.build.begin());
  return record;
}

/// The heading is 30 degrees.
inline messages::Navigation known_fix(Time time) {
  return {.time = time,
          .position = at(1000, 2000),
          .depth = Meters{299.5},
          .heading = Radians{std::numbers::pi / 6},
          .speed = MetersPerSecond{1.75}};
}

/// Of a rule that acts, or no longer does.
inline messages::SafetyEvent event_of(config::Condition condition, config::Response response, bool begins = true) {
  messages::SafetyEvent event;
  event.condition = condition;
  event.response = response;
  event.begins = begins;
  return event;
}

/// At 2 m/s and 300 m depth.
inline messages::Setpoint some_setpoint(bool release_weight = false) {
  messages::Setpoint setpoint;
  setpoint.heading = Radians{0.5};
  setpoint.speed = MetersPerSecond{2};
  setpoint.depth = Meters{300};
  setpoint.release_weight = release_weight;
  return setpoint;
}

inline messages::OperatorCommand command_to(messages::Order order) {
  messages::OperatorCommand command;
  command.order = order;
  return command;
}

/// A mission of four turns: two of them search, a port goes down and comes back, a rule aborts it. kKnownRecords, the closing one among
/// them.
inline void write_known_journal(const std::filesystem::path& path) {
  using messages::EndReason;
  using messages::MissionState;
  WrittenJournal journal(path);
  journal.message(kBegan, wire::kMissionChannel, known_mission());
  journal.bytes(kBegan, wire::kPolicyChannel, kPolicy);
  journal.health(after(1000), 1, MissionState::kStandby);
  journal.input(
      after(1500), 2,
      messages::OperatorCommand{.time = after(1400), .expiry = after(61'400), .issuer = 77, .number = 1, .order = messages::Order::kStart});
  journal.input(after(1900), 1, known_fix(after(1800)));
  journal.input(after(1900), 2, messages::SnrMeasurement{.time = after(1700), .snr = Decibels{12.25}});
  journal.input(after(1950), 1, messages::VehicleStatus{.time = after(1940), .battery_percent = 80.5});
  journal.message(
      after(2000), wire::kJournalledSetpointChannel,
      messages::Setpoint{
          .heading = Radians{-std::numbers::pi / 2}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = at(1000, 1000)});
  messages::Decision decision;
  decision.time = after(2000);
  decision.position = at(1000, 2000);
  decision.snr = Decibels{12.25};
  decision.detected = true;
  decision.action = 6;
  decision.waypoint = at(1000, 1000);
  decision.observation_size = 2;
  decision.action_count = 3;
  decision.observation[1] = 0.5F;
  decision.logits[2] = -1.5F;
  journal.message(after(2000), wire::kDecisionChannel, decision);
  journal.message(after(2000), wire::kAcknowledgementChannel,
                  messages::CommandAcknowledgement{.time = after(2000),
                                                   .port = 2,
                                                   .issuer = 77,
                                                   .number = 1,
                                                   .order = messages::Order::kStart,
                                                   .outcome = messages::CommandOutcome::kObeyed});
  journal.health(after(2000), 2, MissionState::kSearch);
  journal.input(after(2900), 1, messages::PortReport{.port = 2, .link_up = false, .received = 5});
  messages::Navigation nowhere = known_fix(after(2940));
  nowhere.position.north = Meters{std::numeric_limits<double>::quiet_NaN()};
  journal.input(after(2950), 1, nowhere);
  journal.health(after(3000), 3, MissionState::kSearch);
  journal.input(after(3900), 1, messages::PortReport{.port = 2, .link_up = true, .received = 6, .lost = 2});
  journal.message(after(4000), wire::kSafetyEventChannel,
                  messages::SafetyEvent{.time = after(4000),
                                        .rule = 10,
                                        .condition = config::Condition::kBattery,
                                        .response = config::Response::kAbort,
                                        .begins = true,
                                        .measure = 14.9,
                                        .limit = 15});
  journal.health(after(4000), 4, MissionState::kAbort, EndReason::kSafetyRule, 1);
  journal.close({.time = after(4000),
                 .ending = messages::Ending::kMissionOver,
                 .state = MissionState::kAbort,
                 .end_reason = EndReason::kSafetyRule,
                 .steps_taken = 1});
}
inline constexpr std::size_t kKnownRecords = 18;

}  // namespace earshot::journal
