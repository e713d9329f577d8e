#include "policy/evaluate/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "policy/evaluate/csv.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::evaluate {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string shortest(double value) {
  if (std::isnan(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string line_of(const Row& row, std::size_t width) {
  const Summary& s = row.summary;
  const Intervals& i = row.intervals;
  return formatted("%-*s", static_cast<int>(width), row.policy.c_str()) +
         formatted(" %8.2f  %7.2f to %7.2f", s.mean_reward, i.mean_reward.low, i.mean_reward.high) +
         formatted(" %8.2f  %7.2f to %7.2f", s.median_reward, s.lower_quartile_reward, s.upper_quartile_reward) +
         formatted(" %6.1f  %5.1f to %5.1f", 100.0 * s.found_fraction, 100.0 * i.found_fraction.low, 100.0 * i.found_fraction.high) +
         (std::isnan(row.path_over_straight) ? formatted(" %7s", "-") : formatted(" %7.2f", row.path_over_straight)) +
         formatted(" %6.1f %6.1f %6.1f", 100.0 * s.left_domain_fraction, s.mean_steps, s.mean_detections) +
         formatted(" %9.2f\n", 1e6 * row.decision_s);
}

std::vector<std::string> distinct(std::span<const Row> rows, std::string Row::*name) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (std::ranges::find(names, row.*name) == names.end()) names.push_back(row.*name);
  }
  return names;
}

/// The place of one policy's points, and its mark: colour and shape both distinguish it from its neighbours.
std::string points_of(std::size_t policy) {
  constexpr std::array<const char*, 6> kColours{"#1b6ca8", "#d1495b", "#2a9d6f", "#8a5aa8", "#e08a1e", "#4d5b68"};
  constexpr std::array<int, 6> kShapes{7, 5, 9, 13, 11, 15};  // disc, square, triangle, diamond, triangle on its head, pentagon
  return formatted(" using 1:2:3:4 with yerrorbars pt %d ps 1.1 lw 1.5 lc rgb '%s'", kShapes[policy % kShapes.size()],
                   kColours[policy % kColours.size()]);
}

/// One panel: a point with its interval for every row; policies side by side within their world.
/// @param is_named  whether the policies' names stand beside it
template <class Value>
std::string panel(std::span<const Row> rows, const std::string& label, bool is_named, Value value) {
  const std::vector<std::string> policies = distinct(rows, &Row::policy);
  const std::vector<std::string> worlds = distinct(rows, &Row::world);
  const double apart = 0.7 / static_cast<double>(policies.size());
  std::string plot = "set ylabel '" + label + "'\nplot ";
  std::string data;
  for (std::size_t p = 0; p < policies.size(); ++p) {
    plot += (p == 0 ? "'-'" : ", '-'") + points_of(p) + (is_named ? " title " + plot::quoted(policies[p]) : " notitle");
    for (const Row& row : rows) {
      if (row.policy != policies[p]) continue;
      const auto world = static_cast<double>(std::ranges::find(worlds, row.world) - worlds.begin());
      const std::array<double, 3> v = value(row);
      data += formatted("%g %g %g %g\n", world + apart * (static_cast<double>(p) - 0.5 * static_cast<double>(policies.size() - 1)), v[0],
                        v[1], v[2]);
    }
    data += "e\n";
  }
  return plot + "\n" + data;
}

/// gnuplot's list of places along the axis.
std::string tics_of(const std::vector<std::string>& worlds, bool is_named) {
  std::string tics = worlds.size() > 6 ? "set xtics noenhanced rotate by -35 (" : "set xtics noenhanced norotate (";
  for (std::size_t i = 0; i < worlds.size(); ++i)
    tics += (i == 0 ? "" : ", ") + plot::quoted(is_named ? worlds[i] : "") + " " + std::to_string(i);
  return tics + ")\n";
}

}  // namespace

Row row_of(const std::string& world, const std::string& policy, std::span<const Flight> flights, std::uint64_t seed) {
  std::vector<search::EpisodeRecord> records;
  for (const Flight& flight : flights) records.push_back(flight.record);
  return {.world = world,
          .policy = policy,
          .summary = summarise(records),
          .intervals = bootstrap(flights, seed),
          .path_over_straight = path_over_straight(flights),
          .decision_s = decision_time_s(flights)};
}

std::string as_text(std::span<const Row> rows) {
  std::size_t width = 16;
  for (const Row& row : rows) width = std::max(width, row.policy.size());
  std::string text = formatted("%-*s", static_cast<int>(width), "policy") +
                     "   reward       (95 %)          median     (quartiles)      found %" +
                     "    (95 %)      path/   left   steps  heard  us/decision\n" + formatted("%-*s", static_cast<int>(width), "") +
                     "     mean                                                                           line       %   \n";
  for (const Row& row : rows) text += line_of(row, width);
  return text;
}

std::string as_csv(std::span<const Row> rows, Timing timing) {
  std::string csv =
      "world,policy,episodes,mean_reward,mean_reward_low,mean_reward_high,lower_quartile_reward,median_reward,median_reward_low,"
      "median_reward_high,upper_quartile_reward,found_fraction,found_fraction_low,found_fraction_high,left_domain_fraction,"
      "path_over_straight,path_over_straight_low,path_over_straight_high,mean_steps,mean_detections";
  csv += timing == Timing::kIncluded ? ",decision_us\n" : "\n";
  for (const Row& row : rows) {
    const Summary& s = row.summary;
    const Intervals& i = row.intervals;
    csv += csv_cell(row.world) + "," + csv_cell(row.policy) + "," + std::to_string(s.episodes);
    for (const double x : {s.mean_reward, i.mean_reward.low, i.mean_reward.high, s.lower_quartile_reward, s.median_reward,
                           i.median_reward.low, i.median_reward.high, s.upper_quartile_reward, s.found_fraction, i.found_fraction.low,
                           i.found_fraction.high, s.left_domain_fraction, row.path_over_straight, i.path_over_straight.low,
                           i.path_over_straight.high, s.mean_steps, s.mean_detections})
      csv += "," + shortest(x);
    if (timing == Timing::kIncluded) csv += "," + shortest(1e6 * row.decision_s);
    csv += "\n";
  }
  return csv;
}

std::string as_plot(std::span<const Row> all, const std::string& title) {
  std::vector<Row> rows(all.begin(), all.end());
  if (distinct(rows, &Row::world).size() == 1) {  // then policies stand along the axis
    for (Row& row : rows) std::swap(row.world, row.policy);
  }
  const std::vector<std::string> worlds = distinct(rows, &Row::world);
  const bool has_legend = distinct(rows, &Row::policy).size() > 1;
  const std::string setup = "set multiplot title " + plot::quoted(title) +
                            " noenhanced\nset grid ytics lt 1 lw 0.5 lc rgb '#cccccc'\nset key at screen 0.99,0.93 right top noenhanced "
                            "reverse Left\nset tics out nomirror\nset lmargin at screen 0.07\nset rmargin at screen " +
                            (has_legend ? "0.82" : "0.97") +
                            "\nset xrange [-0.5:" + formatted("%g", static_cast<double>(worlds.size()) - 0.5) + "]\n";
  return setup + "set bmargin at screen 0.55\nset tmargin at screen 0.93\nset yrange [*:0]\n" + tics_of(worlds, false) +
         panel(rows, "mean reward (95 %)", has_legend,
               [](const Row& r) {
                 return std::array{r.summary.mean_reward, r.intervals.mean_reward.low, r.intervals.mean_reward.high};
               }) +
         "set bmargin at screen 0.13\nset tmargin at screen 0.51\nset yrange [0:105]\n" + tics_of(worlds, true) +
         panel(rows, "sources found, % (95 %)", false,
               [](const Row& r) {
                 return std::array{100.0 * r.summary.found_fraction, 100.0 * r.intervals.found_fraction.low,
                                   100.0 * r.intervals.found_fraction.high};
               }) +
         "unset multiplot\n";
}

}  // namespace earshot::evaluate
