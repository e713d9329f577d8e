#include "firmware/policy/ocean_belief/silence.hpp"

#include <algorithm>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/likelihood/normal_table.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// From this SNR on a sound is heard, were it no detection.
constexpr Decibels kHeard{3.0};
constexpr float kSpread_db = 4.0F;
/// No measurement is more certain to be a detection: one alone is no long silence, 4 bits.
constexpr float kMostExpected = 0.9375F;
/// A measurement meets a source, whatever is expected, with no more than that.
constexpr float kLeastMissed = 1.0F / 64.0F;
/// A silence so long says no more.
constexpr int kLongest = 1000 * kOctave;
/// Of what is remembered of a source: a measurement that hears it with less than 2 % leaves it as it is.
constexpr int kUnit = kOctave / 16;
constexpr int kMostUnits = 255;
/// Of the sources so many have their measurements worked out at once.
constexpr std::size_t kAtOnce = 32;
static_assert(Silence::kSources % kAtOnce == 0);

/// As often as not a source without pauses is drawn, and one with each other share of them as often as any other.
constexpr float kTriedWithoutPauses = 0.5F;
constexpr float kOthersTried = static_cast<float>(kSilenceShares.size() - 1);

/// A source that the tables think possible.
struct Source {
  NorthEast place;  ///< from the area's south-west corner
  std::uint8_t table;
  std::uint8_t level;    ///< index of kLevelOffsets_db
  std::uint8_t silence;  ///< index of kSilenceShares
};

/// The next, the same ones in every search: each ocean in turn.
Source draw(const BeliefModel& model, const OceanTables& tables, std::size_t index, Pcg32& random) {
  Source source{};
  source.place.north = static_cast<double>(random.uniform_float()) * model.area_size.north;
  source.place.east = static_cast<double>(random.uniform_float()) * model.area_size.east;
  source.table = static_cast<std::uint8_t>(index % tables.tables.size());
  source.level = static_cast<std::uint8_t>(static_cast<int>(random.uniform_float() * static_cast<float>(kLevelOffsets_db.size())));
  const float pauses = random.uniform_float();
  const float other = (pauses - kTriedWithoutPauses) / (1.0F - kTriedWithoutPauses) * kOthersTried;
  source.silence = static_cast<std::uint8_t>(pauses < kTriedWithoutPauses ? 0 : 1 + static_cast<int>(other));
  return source;
}

/// How much likelier it is by the prior than to be drawn, but for a factor that all have.
float weight_of(const Source& source, const OceanTables& tables) {
  const float tried = source.silence == 0 ? kTriedWithoutPauses : (1.0F - kTriedWithoutPauses) / kOthersTried;
  return tables.tables[source.table].prior * kLevelPriors[source.level] * (kSilencePriors[source.silence] / tried);
}

}  // namespace

void Silence::start() {
  unheard_.fill(0);
  against_belief_ = 0;
  against_tables_ = 0;
  is_behind_ = false;
}

float Silence::in_bits(int log) {
  return static_cast<float>(log) * (1.0F / static_cast<float>(kOctave));
}

void Silence::take_in(const BeliefModel& model, NorthEast position, const Reception& reception, float expected) {
  if (!reception.too_faint && reception.snr >= model.detection_threshold) return start();
  against_belief_ = std::min(against_belief_ - to_log(1.0F - std::clamp(expected, 0.0F, kMostExpected)), kLongest);
  const Decibels heard = std::min(kHeard, model.detection_threshold);
  if (reception.bearing || (!reception.too_faint && reception.snr >= heard)) return;
  is_behind_ = true;
  position_ = position;
  least_ = reception.too_faint ? std::max(reception.snr, heard) : heard;
}

void Silence::catch_up(const BeliefModel& model, const OceanTables& tables) {
  is_behind_ = false;
  const float last = static_cast<float>(tables.range_count - 1);
  const float per_step = 1.0F / static_cast<float>(tables.range_step.value);
  Pcg32 random(1);
  float weights = 0.0F;
  float unheard = 0.0F;
  for (std::size_t first = 0; first < kSources; first += kAtOnce) {
    std::array<Source, kAtOnce> sources;
    std::array<float, kAtOnce> heard;
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      sources[i] = draw(model, tables, first + i, random);
      const NorthEast way = sources[i].place - position_;
      const auto north = static_cast<float>(way.north.value);
      const auto east = static_cast<float>(way.east.value);
      const float steps = lesser(__builtin_sqrtf(north * north + east * east) * per_step, last);
      const float snr_db = tables.tables[sources[i].table].snr_db(static_cast<std::size_t>(static_cast<int>(steps)));
      heard[i] = (snr_db + kLevelOffsets_db[sources[i].level] - static_cast<float>(least_.value)) * (1.0F / kSpread_db);
    }
    to_normal_cumulative(heard);
    for (std::size_t i = 0; i < kAtOnce; ++i) {
      const float missed = greater(1.0F - (1.0F - kSilenceShares[sources[i].silence]) * heard[i], kLeastMissed);
      std::uint8_t& units = unheard_[first + i];
      units = static_cast<std::uint8_t>(std::min(units + (kUnit / 2 - to_log(missed)) / kUnit, kMostUnits));
      const float weight = weight_of(sources[i], tables);
      weights += weight;
      unheard += weight * from_log(-kUnit * units);
    }
  }
  against_tables_ = to_log(weights) - to_log(unheard);
}

}  // namespace earshot::policy
