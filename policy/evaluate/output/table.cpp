#include "policy/evaluate/output/table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "firmware/host/text/numbers.hpp"
#include "policy/evaluate/output/csv.hpp"

namespace earshot::evaluate {
namespace {

/// A number so many characters wide; "-" where there is none.
std::string known(const std::string& before, int width, double value) {
  return before + (std::isfinite(value) ? host::formatted("%*.2f", width, value) : host::formatted("%*s", width, "-"));
}

std::string shortest(double value) {
  return std::isnan(value) ? "" : host::shortest(value);
}

/// Cells of a row, without its name.
using Cells = std::string (*)(const Row& row);

std::string found_and_time(const Row& row) {
  const TimeToFind& t = row.time_to_find;
  const Interval& steps_95 = row.intervals.restricted_mean_steps;
  const auto in_hours = [&row](double steps) { return hours(steps, row.pace); };
  return host::formatted(" %6.1f  %5.1f to %5.1f", 100.0 * row.summary.found_fraction, 100.0 * row.found_fraction_95.low,
                         100.0 * row.found_fraction_95.high) +
         known(" ", 7, in_hours(t.median)) + known("  ", 5, in_hours(t.lower_quartile)) + known(" to ", 5, in_hours(t.upper_quartile)) +
         host::formatted(" %6.2f  %5.2f to %5.2f", in_hours(t.restricted_mean), in_hours(steps_95.low), in_hours(steps_95.high));
}

std::string reward(const Row& row) {
  const Summary& s = row.summary;
  const Interval& mean_95 = row.intervals.mean_reward;
  return host::formatted(" %8.2f  %7.2f to %7.2f", s.mean_reward, mean_95.low, mean_95.high) +
         host::formatted(" %8.2f  %7.2f to %7.2f", s.median_reward, s.lower_quartile_reward, s.upper_quartile_reward);
}

std::string way_and_decisions(const Row& row) {
  return known(" ", 9, row.path_over_straight) +
         host::formatted(" %7.1f %9.1f", 100.0 * row.summary.left_domain_fraction, row.summary.mean_detections) +
         known(" ", 9, 100.0 * row.mismatches.fraction) + known(" ", 7, row.mismatches.median_measurement) +
         host::formatted(" %9.2f %10.2f", 1e6 * row.decision_s, 1e6 * row.refinement_s);
}

constexpr std::size_t kLongestName = 28;

/// A header of two lines, then a line for every row.
std::string table_of(std::span<const Row> rows, const std::array<std::string, 2>& header, Cells cells) {
  std::size_t width = 16;
  for (const Row& row : rows) {
    if (row.policy.size() <= kLongestName) width = std::max(width, row.policy.size());
  }
  const auto named = [width](const std::string& name, const std::string& rest) {
    if (name.size() > width) return name + "\n" + std::string(width, ' ') + rest + "\n";
    return name + std::string(width - name.size(), ' ') + rest + "\n";
  };
  std::string text = named("policy", header[0]) + named("", header[1]);
  for (const Row& row : rows) text += named(row.policy, cells(row));
  return text;
}

/// Of the searchers that say themselves whether the source is found: how often they were wrong. Nothing where there are none.
std::string declarations_text(std::span<const Row> rows) {
  std::vector<Row> declaring;
  std::ranges::copy_if(rows, std::back_inserter(declaring), [](const Row& row) { return row.declarations.has_value(); });
  if (declaring.empty()) return "";
  return table_of(declaring,
                  {"   declared     declared    missed",  //
                   "  falsely %    far off %         %"},
                  [](const Row& row) {
                    const DeclarationShares& d = *row.declarations;
                    return host::formatted("  %9.1f    %9.1f", 100.0 * d.falsely, 100.0 * d.far_off) +
                           (std::isfinite(d.missed) ? host::formatted("  %8.1f", 100.0 * d.missed) : "         -");
                  }) +
         "falsely: further than one step length from every source; far off: further than 1.5 step lengths\n"
         "missed: of the searches that came within one step length, those that did not declare it there\n";
}

/// Times to find of a row, steps: quartiles with the median between them, then the restricted mean and its interval.
std::array<double, 6> times_of(const Row& row) {
  const TimeToFind& t = row.time_to_find;
  const Interval& mean_95 = row.intervals.restricted_mean_steps;
  return {t.lower_quartile, t.median, t.upper_quartile, t.restricted_mean, mean_95.low, mean_95.high};
}

}  // namespace

double hours(double steps, const Pace& pace) {
  return steps * pace.step_s / 3'600.0;
}

Row row_of(const std::string& world, const std::string& policy, std::span<const Flight> flights, const Pace& pace, std::uint64_t seed,
           const std::function<void()>& between) {
  std::vector<search::EpisodeRecord> records;
  for (const Flight& flight : flights) records.push_back(flight.record);
  const Summary summary = summarise(records);
  return {.world = world,
          .policy = policy,
          .summary = summary,
          .found_fraction_95 = exact_interval({.found = summary.found, .searches = summary.episodes}),
          .time_to_find = time_to_find(records, pace.max_steps),
          .pace = pace,
          .intervals = bootstrap(flights, pace.max_steps, seed, between),
          .path_over_straight = path_over_straight(flights),
          .mismatches = mismatches(flights),
          .decision_s = decision_time_s(flights),
          .refinement_s = refinement_time_s(flights),
          .declarations = declaration_shares(flights)};
}

std::string as_text(std::span<const Row> rows) {
  std::string text = table_of(rows,
                              {"  found      (95 %)       hours   (quartiles)     mean      (95 %)",  //
                               "      %           %     to find       hours      hours       hours"},
                              found_and_time);
  text += table_of(rows,
                   {"   reward         (95 %)        reward      (quartiles)",  //
                    "     mean                       median"},
                   reward);
  text += table_of(rows,
                   {"    path /    left     heard  mismatch  at SNR  decision   refining",  //
                    "      line  area %     times         %  number        us         us"},
                   way_and_decisions);
  return text + declarations_text(rows);
}

std::string as_csv(std::span<const Row> rows, Timing timing) {
  std::string csv =
      "world,policy,episodes,found_fraction,found_fraction_low,found_fraction_high,lower_quartile_hours_to_find,median_hours_to_find,"
      "upper_quartile_hours_to_find,restricted_mean_hours_to_find,restricted_mean_hours_to_find_low,restricted_mean_hours_to_find_high,"
      "lower_quartile_steps_to_find,median_steps_to_find,upper_quartile_steps_to_find,restricted_mean_steps_to_find,"
      "restricted_mean_steps_to_find_low,restricted_mean_steps_to_find_high,mean_reward,mean_reward_low,mean_reward_high,"
      "lower_quartile_reward,median_reward,median_reward_low,median_reward_high,upper_quartile_reward,left_domain_fraction,"
      "path_over_straight,path_over_straight_low,path_over_straight_high,mean_steps,mean_detections,surprised_fraction,"
      "median_look_of_surprise,declared_falsely_fraction,declared_far_off_fraction,missed_fraction";
  csv += timing == Timing::kIncluded ? ",decision_us,pondering_us\n" : "\n";
  for (const Row& row : rows) {
    const Summary& s = row.summary;
    const Intervals& i = row.intervals;
    csv += csv_cell(row.world) + "," + csv_cell(row.policy) + "," + std::to_string(s.episodes);
    for (const double x : {s.found_fraction, row.found_fraction_95.low, row.found_fraction_95.high}) csv += "," + shortest(x);
    const std::array<double, 6> steps = times_of(row);
    for (const double x : steps) csv += "," + shortest(hours(x, row.pace));
    for (const double x : steps) csv += "," + shortest(x);
    for (const double x :
         {s.mean_reward, i.mean_reward.low, i.mean_reward.high, s.lower_quartile_reward, s.median_reward, i.median_reward.low,
          i.median_reward.high, s.upper_quartile_reward, s.left_domain_fraction, row.path_over_straight, i.path_over_straight.low,
          i.path_over_straight.high, s.mean_steps, s.mean_detections, row.mismatches.fraction, row.mismatches.median_measurement})
      csv += "," + shortest(x);
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const DeclarationShares declared = row.declarations.value_or(DeclarationShares{kUnknown, kUnknown, kUnknown});
    for (const double x : {declared.falsely, declared.far_off, declared.missed}) csv += "," + shortest(x);
    if (timing == Timing::kIncluded) csv += "," + shortest(1e6 * row.decision_s) + "," + shortest(1e6 * row.refinement_s);
    csv += "\n";
  }
  return csv;
}

}  // namespace earshot::evaluate
