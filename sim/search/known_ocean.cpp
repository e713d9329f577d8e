#include "sim/search/known_ocean.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace earshot::search {
namespace {

constexpr double kRangeStep_m = 100.0;

}  // namespace

void make_known_ocean(const SearchSettings& settings, const sonar::SnrCurve& curve, policy::OceanTables& tables) {
  const double furthest_m = range_between(settings.domain.south_west, settings.domain.north_east).value;
  tables.range_step = Meters{std::max(kRangeStep_m, furthest_m / static_cast<double>(config::kMaxTableRanges - 2))};
  tables.range_count =
      static_cast<std::uint16_t>(std::min(config::kMaxTableRanges, static_cast<std::size_t>(furthest_m / tables.range_step.value) + 2));
  policy::OceanTable known;
  [[maybe_unused]] Status status = Status::kOk;
  for (const char letter : std::string_view("told")) status = known.name.push_back(letter);
  for (std::size_t i = 0; i < tables.range_count; ++i)
    known.snr_half_db[i] = policy::to_half_db(curve.at(static_cast<double>(i) * tables.range_step).value);
  tables.tables.clear();
  status = tables.tables.push_back(known);
  assert(status == Status::kOk);
}

}  // namespace earshot::search
