#include "sim/listening/levels.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace earshot::listening {
namespace {

std::vector<float> corrected(std::span<const float> levels_db, Decibels correction) {
  std::vector<float> corrected_db;
  corrected_db.reserve(levels_db.size());
  for (const float level : levels_db)
    corrected_db.push_back(level > -std::numeric_limits<float>::infinity() ? level + static_cast<float>(correction.value)
                                                                           : std::numeric_limits<float>::quiet_NaN());
  return corrected_db;
}

}  // namespace

Levels levels_of(const spectrum::BandLevels& levels, const Plan& plan, std::size_t first) {
  const recording::Sequence& sequence = plan.sequence;
  const std::size_t bands = levels.bands().size();
  Levels given;
  given.is_dated = std::ranges::all_of(sequence.parts(), [](const recording::Part& part) { return part.notes.start.has_value(); });
  for (const std::uint64_t begin : std::span(levels.begins()).subspan(first)) {
    const Time in_sequence = sequence.time_of(begin);
    given.begin_s.push_back((given.is_dated ? *sequence.place_of(in_sequence).utc - Time{} : in_sequence - Time{}).to_seconds());
  }
  given.bands = levels.bands();
  given.level_db = corrected(std::span(levels.mean_level_db()).subspan(first * bands), plan.chain.correction());
  given.level_percentile_db =
      corrected(std::span(levels.percentile_level_db()).subspan(first * bands * spectrum::kPercentiles.size()), plan.chain.correction());
  return given;
}

}  // namespace earshot::listening
