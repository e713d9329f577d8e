#include "tests/safety/flight.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <type_traits>
#include <vector>

#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/fence.hpp"
#include "firmware/safety/limits.hpp"
#include "tests/safety/true_vehicle.hpp"

namespace earshot::campaign {
namespace {

using messages::MissionState;
using messages::Navigation;

constexpr Duration kSecond = Duration::seconds(1);
constexpr Time kBegin{1'000'000'000};
/// Turns between what happens and what follows: of the message, and of the turn that it is judged in.
constexpr Duration kPauseLasts = Duration::seconds(200);
constexpr Duration kSlack = Duration::seconds(2);
constexpr std::int64_t kLeakAfterEnd_s = 20;

/// Puts another number wherever one stands in a runtime, as flipped bits might.
template <class Number>
void replace(runtime::Runtime& runtime, Number number, Number other) {
  static_assert(std::is_trivially_copyable_v<runtime::Runtime>);
  auto* const bytes = reinterpret_cast<unsigned char*>(&runtime);
  for (std::size_t i = 0; i + sizeof(Number) <= sizeof(runtime::Runtime); i += sizeof(Number)) {
    if (std::memcmp(bytes + i, &number, sizeof(Number)) == 0) std::memcpy(bytes + i, &other, sizeof(Number));
  }
}

class Flight {
 public:
  explicit Flight(const DrawnMission& drawn)
      : drawn_(drawn), vehicle_(drawn.start, drawn.vehicle, drawn.mission.safety.vehicle.ascent_speed.value) {}

  FlightResult fly() {
    if (runtime_->configure(drawn_.mission, *drawn_.policy, *std::make_unique<policy::OceanTables>()) != Status::kOk)
      return {.broken = "the mission is refused"};
    const double leg_s = drawn_.mission.step_length.value / drawn_.mission.search_speed.value;
    // A way home may be longer than all steps of a short search.
    const double way_home_s = 40.0 *
                              range_between(drawn_.mission.operating_area.south_west, drawn_.mission.operating_area.north_east).value /
                              drawn_.mission.search_speed.value;
    const auto most_turns = static_cast<std::int64_t>(8.0 * leg_s * (drawn_.mission.max_steps + 2) + way_home_s) + 600;
    for (turns_ = 0; turns_ < most_turns && !is_over() && broken_.empty(); ++turns_) turn();
    if (broken_.empty() && !is_over()) broken_ = "it never ends";
    if (broken_.empty()) judge_end();
    if (broken_.empty() && outputs_.health.state >= MissionState::kDone && outputs_.setpoint && !breaks_vehicle(drawn_.fault)) come_up();
    const messages::Health& health = outputs_.health;
    return {.state = health.state,
            .end_reason = health.end_reason,
            .steps = health.steps_taken,
            .seconds = turns_,
            .was_steered_back = was_steered_back_,
            .broken = broken_};
  }

 private:
  [[nodiscard]] bool is_over() const { return outputs_.health.state >= MissionState::kDone || is_home_; }
  [[nodiscard]] bool is_faulty() const { return began_ && now_ >= *began_ + drawn_.fault_after; }
  [[nodiscard]] bool has(Fault fault) const { return drawn_.fault == fault && is_faulty(); }

  template <class Value>
  void take(const Value& value) {
    runtime_->take({.arrival = now_, .port = 0, .sequence = sequence_++, .value = value});
  }

  void turn() {
    now_ = now_ + kSecond;
    break_vehicle();
    // While Earshot only listens, somebody else keeps the vehicle where it is.
    if (drawn_.fault != Fault::kListenFirst || outputs_.setpoint) vehicle_.pass_second();
    give_navigation();
    give_snr();
    give_rest();
    outputs_ = runtime_->step(now_);
    if (!began_ && outputs_.health.state == MissionState::kSearch) began_ = now_;
    if (outputs_.setpoint) vehicle_.obey(*outputs_.setpoint);
    for (const messages::SafetyEvent& event : outputs_.safety_events)
      was_steered_back_ = was_steered_back_ || event.condition == config::Condition::kOutsideFence;
    check_setpoint();
    check_return();
    if (!is_coming_up_) check_vehicle();
    check_abort();
  }

  /// The mission is over: the vehicle comes up near to where it is, whatever fails, and a leak still releases its weight.
  void come_up() {
    const NorthEast from = vehicle_.position();
    const messages::EndReason reason = outputs_.health.end_reason;
    const Vehicle& vehicle = drawn_.vehicle;
    const double current_mps = std::hypot(vehicle.current_north_mps, vehicle.current_east_mps);
    // Once round, and half a circle more while it turns into it.
    const double round_m = 6.0 * safety::blind_radius(drawn_.mission.safety.vehicle.turn_radius).value;
    const Time ended = now_;
    is_coming_up_ = true;
    const auto comes_up_s = static_cast<std::int64_t>(vehicle_.depth_m() / vehicle.climb_mps) + 60;
    for (std::int64_t s = 0; s < comes_up_s && broken_.empty(); ++s) {
      leaks_ = s >= kLeakAfterEnd_s;
      turn();
      const double drifted_m = current_mps * (now_ - ended).to_seconds();
      const double far_m = range_between(from, vehicle_.position()).value;
      if (far_m > round_m + drifted_m + 5.0) broken_ = "it comes up " + std::to_string(far_m) + " m off";
      const bool is_aborted = has(Fault::kAbortOrder) && outputs_.health.state == MissionState::kAbort;
      if (outputs_.health.end_reason != reason && !is_aborted) broken_ = "it ends twice";
      const Duration leak_lasts = drawn_.mission.safety.rules[0].persistence + kSlack;
      const bool is_watched = reason != messages::EndReason::kMemoryFault;
      const bool must_release = is_watched && leaks_ && now_ > ended + Duration::seconds(kLeakAfterEnd_s) + leak_lasts;
      if (must_release && !outputs_.setpoint->release_weight) broken_ = "the weight is not released after the end";
    }
    if (broken_.empty() && vehicle_.depth_m() > drawn_.mission.safety.vehicle.surface_depth.value) broken_ = "it does not come up";
  }

  void break_vehicle() {
    if (has(Fault::kStuck)) vehicle_.anchor();
    if (has(Fault::kSinks)) vehicle_.sink();
    if (has(Fault::kCarriedAway)) vehicle_.be_carried(3 * drawn_.vehicle.top_speed_mps + 1.0, 0.0);
  }

  void give_navigation() {
    const Navigation fix = vehicle_.fix(now_);
    fixes_.push_back(fix);
    if (fixes_.size() > kKept) fixes_.erase(fixes_.begin());
    if (has(Fault::kNoFix) || (has(Fault::kShortSilence) && is_short_silence())) return;
    if (has(Fault::kLateFixes)) {
      const auto late = static_cast<std::size_t>(drawn_.mission.navigation_timeout.us / 2'000'000);
      if (fixes_.size() > late) take(fixes_[fixes_.size() - 1 - late]);
      return;
    }
    take(fix_sent(fix));
    if (is_first_faulty_turn() && drawn_.fault == Fault::kStrayFix) take(displaced(fix, 20'000.0));
    if (is_first_faulty_turn() && drawn_.fault == Fault::kPoorFix) take(displaced(fix, std::numeric_limits<double>::quiet_NaN()));
    if (has(Fault::kSecondSender)) take(displaced(fix, 10'000.0));
    if (has(Fault::kFixAhead) && turns_ % 2 == 0) {
      Navigation ahead = fix;
      ahead.position = drawn_.start;
      ahead.time = now_ + Duration::milliseconds(2300);
      take(ahead);
    }
  }

  [[nodiscard]] Navigation fix_sent(const Navigation& fix) {
    Navigation told = fix;
    if (has(Fault::kFrozenFix)) {
      if (!frozen_) frozen_ = fix;
      told = *frozen_;
      told.time = now_;
    }
    if (has(Fault::kStuck)) told.position.north = told.position.north + Meters{turns_ % 2 == 0 ? 1.0 : -1.0};
    return told;
  }

  [[nodiscard]] static Navigation displaced(const Navigation& fix, double by_m) {
    Navigation other = fix;
    other.position.north = other.position.north + Meters{by_m};
    return other;
  }

  /// Of a search's faults that last for one turn.
  [[nodiscard]] bool is_first_faulty_turn() const { return is_faulty() && now_ < *began_ + drawn_.fault_after + kSecond; }
  [[nodiscard]] bool is_short_silence() const {
    const Duration silence = std::min(drawn_.mission.navigation_timeout, drawn_.mission.snr_timeout);
    return now_ + kSecond < *began_ + drawn_.fault_after + silence;
  }

  void give_snr() {
    if (has(Fault::kNoSnr) || (has(Fault::kShortSilence) && is_short_silence())) return;
    take(messages::SnrMeasurement{.time = now_, .snr = Decibels{static_cast<double>(turns_ % 40) - 20.0}});
  }

  void give_rest() {
    const auto order = [this](messages::Order what, Duration back, std::uint32_t number) {
      take(messages::OperatorCommand{
          .time = now_ + back, .expiry = now_ + back + Duration::seconds(60), .issuer = 1, .number = number, .order = what});
    };
    if (turns_ == 2) order(drawn_.fault == Fault::kListenFirst ? messages::Order::kListen : messages::Order::kStart, {}, 1);
    if (is_first_faulty_turn() && drawn_.fault == Fault::kListenFirst) order(messages::Order::kStart, {}, 2);
    if (is_first_faulty_turn() && drawn_.fault == Fault::kPause) order(messages::Order::kPause, {}, 2);
    if (has(Fault::kPause) && now_ >= *began_ + drawn_.fault_after + kPauseLasts) order(messages::Order::kResume, {}, 3);
    if (is_first_faulty_turn() && drawn_.fault == Fault::kTightened) tighten();
    if (is_first_faulty_turn() && drawn_.fault == Fault::kOldOrder) order(messages::Order::kComplete, Duration::seconds(-3600), 2);
    if (is_first_faulty_turn() && drawn_.fault == Fault::kAbortOrder) order(messages::Order::kAbort, {}, 3);
    if (is_first_faulty_turn() && drawn_.fault == Fault::kPolicyIsNoNumber) {
      replace(*runtime_, kWatermark, std::numeric_limits<float>::quiet_NaN());
      is_spoiled_ = true;
    }
    if (is_first_faulty_turn() && drawn_.fault == Fault::kOutwardWaypoints) replace(*runtime_, drawn_.mission.edge_margin.value, -20'000.0);
    const double battery_percent = has(Fault::kLowBattery) ? drawn_.battery_at_home_percent - 1.0 : 90.0;
    take(messages::VehicleStatus{
        .time = now_, .altitude = Meters{100.0}, .battery_percent = battery_percent, .has_leak = has(Fault::kLeak) || leaks_});
  }

  /// To a little less than what the mission has; the vehicle has then to come up.
  void tighten() {
    const config::Mission& mission = drawn_.mission;
    take(messages::OperatorCommand{.time = now_,
                                   .expiry = now_,
                                   .issuer = 1,
                                   .number = 2,
                                   .order = messages::Order::kTighten,
                                   .limits = {.max_depth = mission.search_depth * 0.8}});
    tightened_at_ = now_;
  }

  /// A vehicle that was sent home is there in the time that the way takes, and stays.
  void check_return() {
    if (!has(Fault::kLowBattery) || outputs_.health.response != config::Response::kReturn) return;
    const config::Mission& mission = drawn_.mission;
    const config::VehicleLimits& limits = mission.safety.vehicle;
    const double far_m = range_between(vehicle_.position(), *mission.safety.safe_point).value;
    if (!home_by_) {
      const double made_good_mps = (mission.search_speed - limits.max_current).value;
      const double round_m = 2.0 * std::numbers::pi * limits.turn_radius.value;
      home_by_ = now_ + Duration::seconds(static_cast<std::int64_t>((2.0 * far_m + round_m) / made_good_mps) + 60);
    }
    // Where a vehicle that must keep moving, or drifts until it turns back, counts as there.
    const double near_m = 20.0 + 4.0 * limits.turn_radius.value + 30.0;
    if (now_ >= *home_by_ && far_m > near_m) broken_ = "it is not home but " + std::to_string(far_m) + " m off";
    is_home_ = now_ >= *home_by_ + Duration::seconds(300);
  }

  void check_setpoint() {
    if (!outputs_.setpoint) return;
    const messages::Setpoint& s = *outputs_.setpoint;
    const config::Mission& mission = drawn_.mission;
    const double most_mps = std::max(mission.search_speed, mission.safety.vehicle.ascent_speed).value;
    const bool is_right = std::abs(s.heading.value) <= std::numbers::pi && s.speed.value >= 0.0 && s.speed.value <= most_mps &&
                          s.depth.value >= 0.0 && s.depth.value <= mission.max_depth.value && is_finite(s.waypoint);
    if (!is_right) broken_ = "a set-point outside its limits";
    if (tightened_at_ && s.depth > mission.search_depth * 0.8) broken_ = "a set-point below a limit that an operator tightened";
  }

  void check_vehicle() {
    if (breaks_vehicle(drawn_.fault) && is_faulty()) return;
    const double beyond_m = safety::beyond(drawn_.mission.safety.fence->halt, vehicle_.position()).value;
    if (beyond_m > 0.0) broken_ = "the vehicle is " + std::to_string(beyond_m) + " m beyond the halt polygon";
    const double most_m = drawn_.mission.max_depth.value;
    if (vehicle_.depth_m() > most_m) broken_ = "the vehicle is below its depth limit";
  }

  /// By when a fault must have ended the search; none: some other way than by time, or never.
  [[nodiscard]] std::optional<Duration> patience() const {
    const config::Mission& mission = drawn_.mission;
    const double leg_s = mission.step_length.value / mission.search_speed.value;
    switch (drawn_.fault) {
      case Fault::kNoFix:
      case Fault::kFrozenFix:
        return mission.navigation_timeout;
      case Fault::kNoSnr:
        return mission.snr_timeout;
      case Fault::kSecondSender:
        return Duration::seconds(10);
      case Fault::kAbortOrder:
        return Duration{};
      case Fault::kLeak:
        return mission.safety.rules[0].persistence;
      case Fault::kStuck:
        return Duration::seconds(static_cast<std::int64_t>(3.0 * leg_s) + 10);  // what it shivers may end a leg
      default:
        return std::nullopt;
    }
  }

  void check_abort() {
    if (outputs_.health.state == MissionState::kAbort && !may_abort()) broken_ = "an abort for no reason";
    if (!is_faulty() || is_over()) return;
    const std::optional<Duration> patience_of_fault = patience();
    if (patience_of_fault && now_ > *began_ + drawn_.fault_after + *patience_of_fault + kSlack) broken_ = "no abort in time";
    if (is_spoiled_ && outputs_.decision) broken_ = "a decision of a policy that gives no number";
    if (drawn_.fault == Fault::kSinks && vehicle_.depth_m() > drawn_.mission.max_depth.value + 3.0)
      broken_ = "no abort of a vehicle that sinks";
    if (drawn_.fault == Fault::kCarriedAway) check_carried_away();
  }

  void check_carried_away() {
    const bool is_outside = safety::beyond(drawn_.mission.safety.fence->halt, vehicle_.position()).value > 0.0;
    if (!is_outside) outside_since_ = now_;
    if (now_ > outside_since_ + drawn_.mission.navigation_timeout + Duration::seconds(12))
      broken_ = "no abort of a vehicle that is carried away";
  }

  [[nodiscard]] bool may_abort() const { return may_end(drawn_.fault) && is_faulty(); }

  void judge_end() {
    if (outputs_.health.state == MissionState::kDone) return;  // before the fault, or in the turn that it came in
    if (drawn_.fault == Fault::kLeak && !outputs_.setpoint->release_weight) broken_ = "the weight is not released";
  }

  static constexpr std::size_t kKept = 16;

  const DrawnMission& drawn_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  TrueVehicle vehicle_;
  Time now_ = kBegin;
  std::int64_t turns_ = 0;
  std::uint64_t sequence_ = 0;
  std::optional<Time> began_;
  Time outside_since_;
  std::optional<Navigation> frozen_;
  std::vector<Navigation> fixes_;
  bool is_spoiled_ = false;
  bool is_coming_up_ = false;  ///< after the end
  bool leaks_ = false;         ///< likewise
  bool was_steered_back_ = false;
  std::optional<Time> tightened_at_;
  std::optional<Time> home_by_;
  bool is_home_ = false;
  runtime::Outputs outputs_;
  std::string broken_;
};

}  // namespace

FlightResult fly(const DrawnMission& drawn) {
  return Flight(drawn).fly();
}

}  // namespace earshot::campaign
