#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "firmware/host/journal/journal.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::report {

/// The journal of a flight at sea, written record by record as earshotd does.
class SeaJournal {
 public:
  static constexpr std::int64_t kBegan_s = 1'795'000'000;  ///< 2026-11-18 11:06:40 UTC by date(1)

  explicit SeaJournal(const std::filesystem::path& path, NorthEast south_west = {Meters{1'000}, Meters{2'000}}) : journal_(path) {
    messages::MissionRecord record;
    constexpr NorthEast kSize{Meters{25'000}, Meters{25'000}};
    record.mission.operating_area = {.south_west = south_west, .north_east = south_west + kSize};
    record.mission.detection_threshold = Decibels{10.0};
    record.mission.max_steps = 100;
    constexpr std::string_view kBuild = "of a test";
    std::copy(kBuild.begin(), kBuild.end(), record.build.begin());
    append(0, wire::kMissionChannel, wire::Encoded(record, at(0)), host::Priority::kOrder);
  }

  void fix(double s, double north_m, double east_m, MetersPerSecond speed = MetersPerSecond{2}) {
    input(s,
          messages::Navigation{
              .time = at(s), .position = {Meters{north_m}, Meters{east_m}}, .depth = Meters{300}, .heading = Radians{0}, .speed = speed});
  }
  void snr(double s, double db, bool too_faint = false) {
    input(s, messages::SnrMeasurement{.time = at(s), .snr = Decibels{db}, .too_faint = too_faint});
  }
  void battery(double s, double percent) { input(s, messages::VehicleStatus{.time = at(s), .battery_percent = percent}); }
  void order(double s, messages::Order order) {
    input(s, messages::OperatorCommand{.time = at(s), .expiry = at(s), .issuer = 1, .number = 1, .order = order});
  }
  void port(double s, const messages::PortReport& report) { input(s, report, report.port); }
  void setpoint(double s, const messages::Setpoint& setpoint) {
    append(s, wire::kJournalledSetpointChannel, wire::Encoded(setpoint, at(s)), host::Priority::kSteering);
  }
  void file(double s, std::string_view channel, std::span<const std::uint8_t> bytes) {
    if (journal_.append(at(s), channel, bytes, host::Priority::kOrder) != Status::kOk) std::abort();
  }
  void state(double s, messages::MissionState state, messages::EndReason reason, std::uint32_t steps) {
    messages::Health health;
    health.state = state;
    health.end_reason = reason;
    health.steps_taken = steps;
    health.counters.snr_refused = 4;
    health.counters.bearings_refused = 2;
    health.counters.bearings_of_others = 3;
    append(s, wire::kHealthChannel, wire::Encoded(health, at(s)), host::Priority::kOrder);
  }
  /// Of a search.
  void health(double s, std::uint32_t steps, float mismatch_bits, bool is_sweeping, bool is_found) {
    messages::Health health;
    health.state = messages::MissionState::kSearch;
    health.steps_taken = steps;
    health.mismatch_bits = mismatch_bits;
    health.is_sweeping = is_sweeping;
    health.is_found = is_found;
    append(s, wire::kHealthChannel, wire::Encoded(health, at(s)), host::Priority::kOrder);
  }
  void resume(double s) {
    append(s, wire::kJournalResumedChannel, wire::Encoded(messages::JournalResumed{.time = at(s)}), host::Priority::kOrder);
  }
  void decision(double s, messages::Decision decision) {
    decision.time = at(s);
    append(s, wire::kDecisionChannel, wire::Encoded(decision), host::Priority::kSteering);
  }
  void acknowledge(double s, messages::Order order, messages::CommandOutcome outcome) {
    const messages::CommandAcknowledgement acknowledgement{.time = at(s), .issuer = 1, .number = 1, .order = order, .outcome = outcome};
    append(s, wire::kAcknowledgementChannel, wire::Encoded(acknowledgement), host::Priority::kOrder);
  }
  void rule(double s, messages::SafetyEvent event) {
    event.time = at(s);
    append(s, wire::kSafetyEventChannel, wire::Encoded(event), host::Priority::kSteering);
  }
  /// As earshotd writes it when a signal stops it.
  void stop(double s) { own_order(s, messages::Order::kAbort); }
  /// As earshotd gives what its safety record holds again after an outage.
  void own_order(double s, messages::Order order) {
    input(s, messages::OperatorCommand{.time = at(s), .expiry = at(s), .issuer = 0, .number = 1, .order = order}, 0);
  }
  void end(messages::Ending ending) {
    messages::ClosingRecord closing;
    closing.ending = ending;
    journal_.conclude(closing);
    if (journal_.close() != Status::kOk) std::abort();
  }

 private:
  static Time at(double s) { return Time{kBegan_s * 1'000'000 + static_cast<std::int64_t>(s * 1e6)}; }
  void input(double s, const decltype(messages::Input::value)& v, std::uint8_t port = 1) {
    const wire::InputRecord record({.arrival = at(s), .port = port, .sequence = 0, .value = v});
    if (journal_.append(at(s), record.channel(), record.data()) != Status::kOk) std::abort();
  }
  void append(double s, std::string_view channel, const wire::Encoded& data, host::Priority weight) {
    if (journal_.append(at(s), channel, data.bytes(), weight) != Status::kOk) std::abort();
  }

  host::Journal journal_;
};

}  // namespace earshot::report
