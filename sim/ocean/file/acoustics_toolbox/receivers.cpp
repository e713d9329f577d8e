#include "sim/ocean/file/acoustics_toolbox/receivers.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "firmware/host/text/numbers.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using host::Range;

constexpr std::size_t kMostReceivers = 1'000'000;
constexpr double kMaxRange_km = 2000.0;  // as far as `earshot field` goes
constexpr double kNearest_m = 0.01;      // and as near

/// How many numbers, then the numbers; the first and the last with a slash behind stand for as many at equal distances.
std::vector<double> read_numbers(ListReader& file, const std::string& what, Range allowed) {
  const std::size_t count = file.count("number of " + what, 1, kMostReceivers);
  std::vector<double> values(count, std::numeric_limits<double>::quiet_NaN());
  const std::size_t given = file.numbers(values, what);
  if (given == 2 && count > 2) {
    const double first = values[0];
    const double step = (values[1] - first) / static_cast<double>(count - 1);
    for (std::size_t i = 1; i < count; ++i) values[i] = first + static_cast<double>(i) * step;
  } else if (given < count) {
    throw file.error(what, host::counted(given, "number"), "must be " + std::to_string(count) + ", or the first and the last of them");
  }
  for (std::size_t i = 0; i < count; ++i) {
    file.require(what, values[i], allowed);
    if (i > 0 && !(values[i] > values[i - 1])) throw file.error(what, values[i], "must increase");
  }
  return values;
}

std::vector<double> read_source_depths(ListReader& file, Meters sea_floor) {
  std::vector<double> depths_m = read_numbers(file, "source depths in m", Range::at_least(0.0));
  for (const double depth_m : depths_m) {
    if (!(depth_m > 0.0 && depth_m < sea_floor.value))
      throw file.error("source depth in m", depth_m, "must be in the water, above 0 and less than " + host::shortest(sea_floor.value));
  }
  return depths_m;
}

/// What kind of run BELLHOP's file asks for. Rays and arrivals have receivers too, and what is said of beams is BELLHOP's own affair.
void require_computable_run(ListReader& file) {
  if (file.at_end()) return;
  std::string run = file.text("run type");
  run.resize(std::max<std::size_t>(run.size(), 5), ' ');
  if (std::string("CREAa ").find(run[0]) == std::string::npos)
    throw file.error("run type", run, "the first letter must be C, R, E, A or a: coherent sound, in two dimensions");
  if (run[3] == 'X') throw file.error("run type", run, "the fourth letter must not be X: the source is a point, R");
  if (run[4] == 'I') throw file.error("run type", run, "the fifth letter must not be I: all ranges have the same depths, R");
}

}  // namespace

Receivers read_receivers(ListReader& file, Meters sea_floor) {
  const Range depth_m = Range::between(0.0, 12'000.0);
  Receivers receivers{};
  const bool is_of_modes = file.numbers_ahead() >= 2;  // a number of source depths stands alone
  if (is_of_modes) {
    std::array<double, 2> phase_speeds_mps{};
    file.numbers(phase_speeds_mps, "phase speeds in m/s");
    const double range_km = file.number("maximum range in km", Range::between(0.0, kMaxRange_km));
    if (range_km > 0.0 && !(1000.0 * range_km >= kNearest_m))
      throw file.error("maximum range in km", range_km, "must be 0, or 0.00001 or more, 1 cm");
    if (range_km > 0.0) receivers.max_range = Meters{1000.0 * range_km};
  }
  receivers.source_depth_m = read_source_depths(file, sea_floor);
  receivers.depth_m = read_numbers(file, "receiver depths in m", depth_m);
  if (is_of_modes) return receivers;
  receivers.range_m = read_numbers(file, "receiver ranges in km", Range::between(0.0, kMaxRange_km));
  if (const double last_km = receivers.range_m.back(); !(1000.0 * last_km >= kNearest_m))
    throw file.error("receiver ranges in km", last_km, "one at least must be 0.00001 or more, 1 cm");
  for (double& range : receivers.range_m) range *= 1000.0;
  require_computable_run(file);
  return receivers;
}

}  // namespace earshot::ocean::acoustics_toolbox
