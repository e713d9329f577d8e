#include "tests/safety/lying_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <vector>

#include "firmware/core/math.hpp"
#include "firmware/core/random.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/safety/fence.hpp"
#include "tests/firmware/place.hpp"
#include "tests/safety/true_vehicle.hpp"

namespace earshot::campaign {
namespace {

using messages::MissionState;
using messages::Navigation;

constexpr Duration kSecond = Duration::seconds(1);
constexpr Time kBegin{1'000'000'000};
constexpr std::array<std::string_view, kSensors> kSensorWords{"depth", "place", "heading", "speed"};
constexpr std::array<std::string_view, kLieKinds> kKindWords{"stuck", "jitter", "drift", "jump", "delay", "second sender"};
constexpr std::array<std::string_view, kWays> kWayWords{"fresher", "ahead", "of the same dates", "of another port"};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, 55) {}
  double between(double low, double high) { return low + (high - low) * random_.uniform_double(); }
  /// As often between 1 and 10 as between 10 and 100.
  double by_size(double low, double high) { return low * std::exp(std::log(high / low) * random_.uniform_double()); }
  bool chance(double share) { return random_.uniform_double() < share; }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(random_.uniform_double() * static_cast<double>(count)); }

 private:
  Pcg32 random_;
};

double size_of(const Lie& lie, Draw& draw) {
  const double sign = draw.chance(0.5) ? 1.0 : -1.0;
  if (lie.kind == LieKind::kDelay) return draw.between(2.0, 60.0);
  const bool is_rate = lie.kind == LieKind::kDrift || lie.kind == LieKind::kSecondSender;
  switch (lie.sensor) {
    case Sensor::kDepth:
      if (lie.kind == LieKind::kJitter) return draw.by_size(0.01, 1.0);
      return sign * (is_rate ? draw.by_size(0.01, 3.0) : draw.by_size(5.0, 600.0));
    case Sensor::kPlace:
      if (lie.kind == LieKind::kJitter) return draw.by_size(0.01, 3.0);
      return is_rate ? draw.by_size(0.1, 20.0) : draw.by_size(10.0, 20'000.0);
    case Sensor::kHeading:
      if (lie.kind == LieKind::kJitter) return draw.by_size(0.01, 1.0);
      return sign * (is_rate ? draw.by_size(0.001, 0.3) : draw.between(0.1, std::numbers::pi));
    case Sensor::kSpeed:
      if (lie.kind == LieKind::kJitter) return draw.by_size(0.01, 1.0);
      return sign * (is_rate ? draw.by_size(0.0001, 0.1) : draw.by_size(0.1, 20.0));
  }
  return 0.0;
}

Lie lie_of(Draw& draw) {
  Lie lie{.sensor = static_cast<Sensor>(draw.index(kSensors)), .kind = static_cast<LieKind>(draw.index(kLieKinds))};
  lie.size = size_of(lie, draw);
  lie.towards = draw.between(0.0, 2.0 * std::numbers::pi);
  lie.fixes = 1 + draw.index(8);
  lie.is_clamped = draw.chance(0.5);
  lie.way = static_cast<Way>(draw.index(kWays));
  if (draw.chance(0.5)) return lie;
  // Half of them say and pause for about as long as a rule waits and remembers.
  const bool is_near_a_limit = draw.chance(0.5);
  lie.says_s = static_cast<std::int64_t>(is_near_a_limit ? draw.between(2.0, 12.0) : draw.by_size(1.0, 300.0));
  lie.pauses_s = static_cast<std::int64_t>(is_near_a_limit ? draw.between(1.0, 6.0) : draw.by_size(1.0, 300.0));
  lie.changes_way = draw.chance(0.5);
  return lie;
}

/// It says what it does while the first pauses.
void take_turns(const Lie& first, Lie& second) {
  second.says_s = first.pauses_s;
  second.pauses_s = first.says_s;
  second.later_s = first.says_s;
}

/// What a lie makes of a navigation.
class Liar {
 public:
  Liar(const Lie& lie, std::uint64_t seed) : lie_(lie), random_(seed) {}

  [[nodiscard]] bool is_second_sender() const { return lie_.kind == LieKind::kSecondSender; }
  [[nodiscard]] std::size_t fixes() const { return lie_.fixes; }
  [[nodiscard]] double away_m(std::int64_t since_s) const {
    return lie_.sensor == Sensor::kPlace ? lie_.size * static_cast<double>(since_s) : 0.0;
  }
  [[nodiscard]] bool lies_at(std::int64_t since_s) const {
    if (lie_.says_s == 0) return true;
    return since_s >= lie_.later_s && (since_s - lie_.later_s) % period_s() < lie_.says_s;
  }
  [[nodiscard]] Way way_at(std::int64_t since_s) const {
    if (!lie_.changes_way) return lie_.way;
    const auto turn = static_cast<std::size_t>(std::max<std::int64_t>(since_s - lie_.later_s, 0) / period_s());
    return static_cast<Way>((static_cast<std::size_t>(lie_.way) + turn) % kWays);
  }

  /// @param before  what was true, a second apart, the newest last
  Navigation told(const Navigation& truth, std::int64_t since_s, const std::deque<Navigation>& before) {
    Navigation told = truth;
    const auto s = static_cast<double>(since_s);
    switch (lie_.kind) {
      case LieKind::kStuck:
        put(begin_ ? *begin_ : truth, 0.0, told);
        break;
      case LieKind::kJitter:
        put(begin_ ? *begin_ : truth, lie_.size * (2.0 * random_.uniform_double() - 1.0), told);
        break;
      case LieKind::kDrift:
      case LieKind::kSecondSender:
        put(truth, lie_.size * s, told);
        break;
      case LieKind::kJump:
        put(truth, lie_.size, told);
        break;
      case LieKind::kDelay:
        put(before[before.size() - 1 - std::min(static_cast<std::size_t>(lie_.size), before.size() - 1)], 0.0, told);
        break;
    }
    if (!begin_) begin_ = truth;
    if (lie_.is_clamped) told.depth = std::max(told.depth, Meters{0.0});
    return told;
  }

 private:
  /// One number of `from`, off by so much.
  void put(const Navigation& from, double off, Navigation& told) const {
    switch (lie_.sensor) {
      case Sensor::kDepth:
        told.depth = from.depth + Meters{off};
        break;
      case Sensor::kPlace:
        told.position = from.position + at(off * std::cos(lie_.towards), off * std::sin(lie_.towards));
        break;
      case Sensor::kHeading:
        told.heading = wrap_to_pi(from.heading + Radians{off});
        break;
      case Sensor::kSpeed:
        told.speed = from.speed + MetersPerSecond{off};
        break;
    }
  }

  [[nodiscard]] std::int64_t period_s() const { return lie_.says_s + lie_.pauses_s; }

  Lie lie_;
  Pcg32 random_;
  std::optional<Navigation> begin_;
};

/// How much deeper than it is a vehicle may have said that it is, until a rule ended its search. One that drifts is found out before that.
double most_too_deep_m(const LyingMission& mission) {
  constexpr double kMostDrifted_m = 100.0;
  double most_m = 0.0;
  for (const std::optional<Lie>& lie : {mission.first, mission.second}) {
    if (lie && lie->sensor == Sensor::kDepth) most_m += lie->kind == LieKind::kJump ? std::max(lie->size, 0.0) : kMostDrifted_m;
  }
  return most_m;
}

bool is_depth_lied(const LyingMission& mission) {
  return std::ranges::any_of(std::array{mission.first, mission.second},
                             [](const auto& lie) { return lie && lie->sensor == Sensor::kDepth; });
}

class LyingFlight {
 public:
  explicit LyingFlight(const LyingMission& lying)
      : lying_(lying),
        mission_(lying.drawn.mission),
        vehicle_(lying.drawn.start, lying.drawn.vehicle, mission_.safety.vehicle.ascent_speed.value, lying.turns_up_s),
        noise_(mission_.action_seed, 7) {
    if (lying.first) liars_.emplace_back(*lying.first, mission_.action_seed);
    if (lying.second) liars_.emplace_back(*lying.second, mission_.action_seed + 1);
  }

  LyingResult fly() {
    if (runtime_->configure(mission_, *lying_.drawn.policy, *std::make_unique<policy::OceanTables>()) != Status::kOk) {
      result_.broken = "the mission is refused";
      return result_;
    }
    for (std::int64_t turns = 0; turns < 60 && !began_; ++turns) turn();
    while (began_ && outputs_.health.state == MissionState::kSearch) turn();
    searched_at_end_s_ = searched_s();
    // What it takes at the most to come up, and to stop there.
    const double deepest_m = 1.1 * (mission_.max_depth.value + most_too_deep_m(lying_)) + 60.0;
    const auto comes_up_s = static_cast<std::int64_t>(deepest_m / config::kSlowestAscent.value) + 1300;
    for (std::int64_t s = 0; s < comes_up_s && stopped_s_ < 30; ++s) {
      turn();
      stopped_s_ = outputs_.setpoint && !(outputs_.setpoint->speed.value > 0.0) && vehicle_.depth_m() <= kUp_m ? stopped_s_ + 1 : 0;
    }
    result_.depth_m = vehicle_.depth_m();
    judge();
    return result_;
  }

 private:
  static constexpr double kUp_m = 0.5;
  static constexpr std::int64_t kDelay_ms = 200;
  /// A rule waits for ten seconds, fixes come and are judged once a second, and one in three may be noise until some have come.
  static constexpr double kMostContradicted_s = 15.0;

  void judge() {
    if (!began_) result_.broken = "it does not begin";
    if (stopped_s_ < 30) {
      result_.keeps_coming_up = is_depth_lied(lying_);
      if (!result_.keeps_coming_up) result_.broken = "it is not told to stop where it came up";
    }
    if (result_.depth_m > kUp_m) result_.broken = "it stays " + std::to_string(result_.depth_m) + " m below";
    if (result_.beyond_halt_m > most_beyond_m(lying_, searched_at_end_s_ - lying_.lies_from_s))
      result_.broken = "it is " + std::to_string(result_.beyond_halt_m) + " m beyond the halt polygon";
    if (!lying_.first && result_.alarm) result_.broken = "a false alarm";
    if (contradicted_s_ > kMostContradicted_s) result_.broken = "two senders contradict each other, and it goes on";
  }

  [[nodiscard]] std::int64_t searched_s() const { return began_ ? (now_ - *began_).us / 1'000'000 : 0; }
  [[nodiscard]] bool is_lied() const { return began_ && searched_s() >= lying_.lies_from_s; }

  template <class Value>
  void take(const Value& value, std::uint8_t port = 0) {
    runtime_->take({.arrival = now_, .port = port, .sequence = sequence_++, .value = value});
  }

  void turn() {
    now_ = now_ + kSecond;
    vehicle_.pass_second();
    give_navigation();
    take(messages::SnrMeasurement{.time = now_, .snr = Decibels{static_cast<double>(sequence_ % 40) - 20.0}});
    if (!began_ && sequence_ > 4) order(messages::Order::kStart);
    if (began_ && !is_aborted_ && searched_s() >= lying_.abort_at_s) {
      is_aborted_ = true;
      order(messages::Order::kAbort);
    }
    outputs_ = runtime_->step(now_);
    if (!began_ && outputs_.health.state == MissionState::kSearch) began_ = now_;
    if (outputs_.setpoint) vehicle_.obey(*outputs_.setpoint);
    for (const messages::SafetyEvent& event : outputs_.safety_events) {
      if (!event.begins || event.response < config::Response::kAbort || result_.alarm) continue;
      result_.alarm = event.condition;
      result_.alarm_s = searched_s();
    }
    if (outputs_.health.state == MissionState::kSearch) {
      contradicted_s_ = is_contradicted_ ? contradicted_s_ + 1.0 : std::max(contradicted_s_ - 0.5, 0.0);
      const double beyond_m = safety::beyond(mission_.safety.fence->halt, vehicle_.position()).value;
      result_.beyond_halt_m = std::max(result_.beyond_halt_m, beyond_m);
    }
  }

  void order(messages::Order what) {
    take(messages::OperatorCommand{.time = now_, .expiry = now_ + Duration::seconds(60), .issuer = 1, .number = ++orders_, .order = what});
  }

  double noise(double most) { return most * (2.0 * noise_.uniform_double() - 1.0); }

  void give_navigation() {
    Navigation fix = vehicle_.fix(now_);
    const double m = lying_.place_noise_m;
    fix.position = fix.position + at(noise(m), noise(m));
    fix.depth = fix.depth + Meters{noise(0.3)};
    fix.heading = wrap_to_pi(fix.heading + Radians{lying_.compass_bias_rad + noise(0.03)});
    fix.speed = MetersPerSecond{fix.speed.value * lying_.speed_log_scale + noise(0.03)};
    before_.push_back(fix);
    if (before_.size() > 64) before_.pop_front();
    is_contradicted_ = false;
    if (!is_lied()) return take(fix);
    Navigation told = fix;
    const std::int64_t since_s = searched_s() - lying_.lies_from_s;
    for (Liar& liar : liars_) {
      if (!liar.is_second_sender() && liar.lies_at(since_s)) told = liar.told(told, since_s, before_);
    }
    for (Liar& liar : liars_) {
      if (liar.is_second_sender() && liar.lies_at(since_s)) send_beside(liar, told, since_s);
    }
    told.time = now_ + Duration::milliseconds(-kDelay_ms);  // its clock is right, and a message takes its time
    take(told);
  }

  /// Further than noise and the way of a second or two.
  [[nodiscard]] double far_m() const {
    const config::VehicleLimits& vehicle = mission_.safety.vehicle;
    return 100.0 + 2.0 * (vehicle.max_speed + vehicle.max_current).value;
  }

  void send_beside(Liar& liar, const Navigation& told, std::int64_t since_s) {
    constexpr std::int64_t kAhead_ms = 400;
    const auto fixes = static_cast<std::int64_t>(liar.fixes());
    const Way way = liar.way_at(since_s);
    is_contradicted_ = is_contradicted_ || liar.away_m(since_s) > far_m();
    for (std::int64_t i = 0; i < fixes; ++i) {
      Navigation other = liar.told(told, since_s, before_);
      const std::int64_t newest_ms = way == Way::kAhead ? kAhead_ms : way == Way::kFresher ? 0 : -kDelay_ms;
      other.time = now_ + Duration::milliseconds(newest_ms - 100 * (fixes - 1 - i) / fixes);
      take(other, way == Way::kOtherPort ? 1 : 0);
    }
  }

  const LyingMission& lying_;
  const config::Mission& mission_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  TrueVehicle vehicle_;
  Pcg32 noise_;
  std::vector<Liar> liars_;
  std::deque<Navigation> before_;
  Time now_ = kBegin;
  std::optional<Time> began_;
  std::uint64_t sequence_ = 0;
  std::uint32_t orders_ = 0;
  std::int64_t searched_at_end_s_ = 0;
  std::int64_t stopped_s_ = 0;  ///< at the surface
  bool is_aborted_ = false;
  bool is_contradicted_ = false;  ///< this second, by a second sender
  double contradicted_s_ = 0.0;   ///< less half of the time in which it was not
  runtime::Outputs outputs_;
  LyingResult result_;
};

std::string words_of(const Lie& lie) {
  return std::string(kSensorWords.at(static_cast<std::size_t>(lie.sensor))) + " " +
         std::string(kKindWords.at(static_cast<std::size_t>(lie.kind))) + " " + std::to_string(lie.size) +
         (lie.is_clamped ? " clamped" : "") +
         (lie.kind == LieKind::kSecondSender
              ? " " + std::to_string(lie.fixes) + " a second " + std::string(kWayWords.at(static_cast<std::size_t>(lie.way)))
              : "") +
         (lie.changes_way ? " and then others" : "") +
         (lie.says_s > 0 ? " for " + std::to_string(lie.says_s) + " of " + std::to_string(lie.says_s + lie.pauses_s) + " s" : "");
}

}  // namespace

LyingMission draw_lying(std::uint64_t seed, bool is_honest) {
  LyingMission lying;
  // One whose owner says how strong the current may be.
  for (std::uint64_t again = 0; again == 0 || !(lying.drawn.mission.safety.vehicle.max_current.value > 0.0); ++again)
    lying.drawn = draw(seed + (again << 32U));
  Draw draw(seed);
  config::VehicleLimits& vehicle = lying.drawn.mission.safety.vehicle;
  vehicle.ascent_rate = MetersPerSecond{std::max(lying.drawn.vehicle.climb_mps * draw.between(0.5, 1.0), config::kSlowestAscent.value)};
  if (vehicle.ascent_speed > MetersPerSecond{}) vehicle.ascent_rate = std::min(vehicle.ascent_rate, vehicle.ascent_speed);
  if (draw.chance(0.5)) vehicle.ascent_rate = config::kSlowestAscent;
  if (!is_honest) {
    lying.first = lie_of(draw);
    if (draw.chance(0.5)) lying.second = lie_of(draw);
    if (lying.second && lying.first->says_s > 0 && draw.chance(0.5)) take_turns(*lying.first, *lying.second);
  }
  lying.lies_from_s = static_cast<std::int64_t>(draw.by_size(1.0, 2000.0));
  lying.abort_at_s = static_cast<std::int64_t>(draw.chance(0.3) ? draw.by_size(10.0, 6000.0) : 1e6);
  lying.compass_bias_rad = draw.between(-0.05, 0.05);
  lying.speed_log_scale = draw.between(0.95, 1.05);
  lying.place_noise_m = draw.chance(0.5) ? 0.0 : draw.between(0.0, 8.0);
  lying.turns_up_s = draw.between(0.0, 60.0);
  return lying;
}

MetersPerSecond slowest_noticed_drift(const config::Mission& mission) {
  return 2.0 * mission.safety.vehicle.max_current + 0.3 * mission.search_speed + MetersPerSecond{0.1};
}

double most_beyond_m(const LyingMission& mission, std::int64_t lied_s) {
  double slow_mps = 0.0;
  for (const std::optional<Lie>& lie : {mission.first, mission.second}) {
    const bool is_drift = lie && lie->sensor == Sensor::kPlace && lie->kind == LieKind::kDrift;  // of two senders each tells of the other
    if (is_drift) slow_mps += lie->size;
  }
  const bool is_reported = slow_mps > slowest_noticed_drift(mission.drawn.mission).value;
  return kMostBeyond_m + (is_reported ? 0.0 : slow_mps * static_cast<double>(std::max<std::int64_t>(lied_s, 0)));
}

LyingResult fly_lying(const LyingMission& mission) {
  return LyingFlight(mission).fly();
}

std::string words_of(const LyingMission& mission) {
  std::string words = mission.first ? words_of(*mission.first) : "honest";
  if (mission.second) words += " and " + words_of(*mission.second);
  return words + ", lies from " + std::to_string(mission.lies_from_s) + " s, ABORT at " + std::to_string(mission.abort_at_s) + " s";
}

}  // namespace earshot::campaign
