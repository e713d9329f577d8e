#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/config/safety.hpp"
#include "tests/safety/drawn_mission.hpp"

namespace earshot::campaign {

/// Which of a navigation's numbers is a lie.
enum class Sensor : std::uint8_t { kDepth, kPlace, kHeading, kSpeed };
inline constexpr std::size_t kSensors = 4;

enum class LieKind : std::uint8_t {
  kStuck,         ///< it goes on saying what it said
  kJitter,        ///< likewise, and shivers
  kDrift,         ///< away from the truth by so much a second
  kJump,          ///< by so much, for good
  kDelay,         ///< what was true so many seconds ago, under the date of now
  kSecondSender,  ///< a second navigation, all of whose numbers but this one are true, and perhaps more fixes
};
inline constexpr std::size_t kLieKinds = 6;

/// How a second sender's fixes come.
enum class Way : std::uint8_t { kFresher, kAhead, kSameDates, kOtherPort };
inline constexpr std::size_t kWays = 4;

struct Lie {
  Sensor sensor = Sensor::kDepth;
  LieKind kind = LieKind::kStuck;
  double size = 0.0;         ///< metres, radians or metres per second; of a drift each second; of a delay seconds
  double towards = 0.0;      ///< of a place
  std::size_t fixes = 1;     ///< of a second sender, in a second
  Way way = Way::kFresher;   ///< likewise
  bool changes_way = false;  ///< likewise, with each pause
  std::int64_t says_s = 0;   ///< for so long, then it is silent, and all over again; 0: it never pauses
  std::int64_t pauses_s = 0;
  std::int64_t later_s = 0;  ///< it begins so much later than the other
  bool is_clamped = false;   ///< a depth never reads less than nothing
};

struct LyingMission {
  DrawnMission drawn;
  std::optional<Lie> first;  ///< none: all is honest
  std::optional<Lie> second;
  std::int64_t lies_from_s = 0;   ///< of the search
  std::int64_t abort_at_s = 0;    ///< likewise: somebody gives an ABORT
  double compass_bias_rad = 0.0;  ///< of an honest vehicle
  double speed_log_scale = 1.0;   ///< likewise
  double place_noise_m = 0.0;     ///< at most, either side
  double turns_up_s = 0.0;        ///< that the vehicle takes before it begins to come up
};

/// Of one seed. @param is_honest  nobody lies
[[nodiscard]] LyingMission draw_lying(std::uint64_t seed, bool is_honest);

struct LyingResult {
  std::optional<config::Condition> alarm;  ///< that ended the search
  std::int64_t alarm_s = 0;                ///< of the search
  double beyond_halt_m = 0.0;              ///< the true vehicle, at most, while it searched
  double depth_m = 0.0;                    ///< the true vehicle's, when it was told to stop
  bool keeps_coming_up = false;            ///< at the surface it is not told to stop: a false depth goes on stating that it is below
  std::string broken;                      ///< what was promised and not kept
};

/// A place that is made to drift faster is found to: the current may run the other way, and heading and speed have their errors.
[[nodiscard]] MetersPerSecond slowest_noticed_drift(const config::Mission& mission);
/// How far beyond the halt polygon the true vehicle may be while it searches: as far as a dead reckoning that is put right may jump; and as
/// far as a place was made to drift that no other source tells from the current.
inline constexpr double kMostBeyond_m = 500.0;
[[nodiscard]] double most_beyond_m(const LyingMission& mission, std::int64_t lied_s);

[[nodiscard]] LyingResult fly_lying(const LyingMission& mission);

[[nodiscard]] std::string words_of(const LyingMission& mission);

}  // namespace earshot::campaign
