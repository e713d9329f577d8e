#include "policy/evaluate/output/table_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "firmware/host/text/numbers.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::evaluate {
namespace {

std::vector<std::string> distinct(std::span<const Row> rows, std::string Row::*name) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (std::ranges::find(names, row.*name) == names.end()) names.push_back(row.*name);
  }
  return names;
}

const char* colour_of(std::size_t policy) {
  constexpr std::array<const char*, 6> kColours{"#1b6ca8", "#d1495b", "#2a9d6f", "#8a5aa8", "#e08a1e", "#4d5b68"};
  return kColours[policy % kColours.size()];
}

/// The place of one policy's points, and its mark: colour and shape both distinguish it from its neighbours.
std::string points_of(std::size_t policy) {
  constexpr std::array<int, 6> kShapes{7, 5, 9, 13, 11, 15};  // disc, square, triangle, diamond, triangle on its head, pentagon
  return host::formatted(" using 1:2:3:4 with yerrorbars pt %d ps 1.1 lw 1.5 lc rgb '%s'", kShapes[policy % kShapes.size()],
                         colour_of(policy));
}

/// Where a policy's point stands along the axis: policies side by side within their world.
double place_of(const Row& row, std::size_t policy, std::size_t policies, const std::vector<std::string>& worlds) {
  const auto world = static_cast<double>(std::ranges::find(worlds, row.world) - worlds.begin());
  const double apart = 0.7 / static_cast<double>(policies);
  return world + apart * (static_cast<double>(policy) - 0.5 * static_cast<double>(policies - 1));
}

/// Below it a mean reward is an outlier, by which no picture of the others may be ruled: 6 median absolute deviations under the median.
double least_usual_reward(std::span<const Row> rows) {
  std::vector<double> rewards;
  for (const Row& row : rows) rewards.push_back(row.summary.mean_reward);
  const double median = quantile(rewards, 0.5);
  for (double& reward : rewards) reward = std::abs(reward - median);
  constexpr double kLeastDeviation = 0.5;  // where most are alike
  return median - 6.0 * std::max(quantile(rewards, 0.5), kLeastDeviation);
}

/// The axis of the rewards: it ends where the usual ones end, and an outlier stands at its lower end as an arrowhead with its number. So
/// does, open, the end of an interval that reaches below it.
std::string reward_axis(std::span<const Row> rows) {
  const double least_usual = least_usual_reward(rows);
  const std::vector<std::string> policies = distinct(rows, &Row::policy);
  const std::vector<std::string> worlds = distinct(rows, &Row::world);
  double low = 0.0;
  for (const Row& row : rows) {
    if (row.summary.mean_reward >= least_usual) low = std::min(low, std::max(least_usual, row.intervals.mean_reward.low));
  }
  low *= 1.05;
  const bool has_outlier = std::ranges::any_of(rows, [&](const Row& row) { return row.summary.mean_reward < least_usual; });
  if (!has_outlier) return "set yrange [*:0]\n";
  std::string labels;
  for (const Row& row : rows) {
    const auto policy = static_cast<std::size_t>(std::ranges::find(policies, row.policy) - policies.begin());
    const double place = place_of(row, policy, policies.size(), worlds);
    if (row.summary.mean_reward < least_usual)
      labels += host::formatted("set label '%.1f' at first %g, graph 0.03 left rotate by 90 offset 0,0.6 point pt 11 ps 1.1 lc rgb '%s'\n",
                                row.summary.mean_reward, place, colour_of(policy));
    else if (row.intervals.mean_reward.low < low)
      labels +=
          host::formatted("set label 'to %.1f' at first %g, graph 0.03 left rotate by 90 offset 0.8,0.6 point pt 10 ps 1.1 lc rgb '%s'\n",
                          row.intervals.mean_reward.low, place, colour_of(policy));
  }
  return host::formatted("set yrange [%g:0]\n", low) + labels;
}

/// One panel: a point with its interval for every row; policies side by side within their world.
/// @param is_named  whether the policies' names stand beside it
template <class Value>
std::string panel(std::span<const Row> rows, const std::string& label, bool is_named, Value value) {
  const std::vector<std::string> policies = distinct(rows, &Row::policy);
  const std::vector<std::string> worlds = distinct(rows, &Row::world);
  std::string plot = "set ylabel '" + label + "'\nplot ";
  std::string data;
  for (std::size_t p = 0; p < policies.size(); ++p) {
    plot += (p == 0 ? "'-'" : ", '-'") + points_of(p) + (is_named ? " title " + plot::quoted(policies[p]) : " notitle");
    for (const Row& row : rows) {
      if (row.policy != policies[p]) continue;
      const std::array<double, 3> v = value(row);
      data += host::formatted("%g %g %g %g\n", place_of(row, p, policies.size(), worlds), v[0], v[1], v[2]);
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

std::string as_plot(std::span<const Row> all, const std::string& title) {
  std::vector<Row> rows(all.begin(), all.end());
  if (distinct(rows, &Row::world).size() == 1) {  // then policies stand along the axis
    for (Row& row : rows) std::swap(row.world, row.policy);
  }
  const std::vector<std::string> worlds = distinct(rows, &Row::world);
  const bool has_legend = distinct(rows, &Row::policy).size() > 1;
  const std::string setup = "set multiplot title " + plot::quoted(title) +
                            " noenhanced\nset grid ytics lt 1 lw 0.5 lc rgb '#cccccc'\nset key at screen 0.99,0.94 right top noenhanced "
                            "reverse Left\nset tics out nomirror\nset lmargin at screen 0.07\nset rmargin at screen " +
                            (has_legend ? "0.82" : "0.97") +
                            "\nset xrange [-0.5:" + host::formatted("%g", static_cast<double>(worlds.size()) - 0.5) + "]\n";
  return setup + "set bmargin at screen 0.68\nset tmargin at screen 0.94\nset yrange [0:105]\n" + tics_of(worlds, false) +
         panel(rows, "sources found, % (95 %)", has_legend,
               [](const Row& r) {
                 return std::array{100.0 * r.summary.found_fraction, 100.0 * r.found_fraction_95.low, 100.0 * r.found_fraction_95.high};
               }) +
         "set bmargin at screen 0.40\nset tmargin at screen 0.65\nset yrange [0:*]\n" + tics_of(worlds, false) +
         panel(rows, "mean hours to find (95 %)", false,
               [](const Row& r) {
                 const Interval& steps = r.intervals.restricted_mean_steps;
                 return std::array{hours(r.time_to_find.restricted_mean, r.pace), hours(steps.low, r.pace), hours(steps.high, r.pace)};
               }) +
         "set bmargin at screen 0.12\nset tmargin at screen 0.37\n" + reward_axis(rows) + tics_of(worlds, true) +
         panel(rows, "mean reward (95 %)", false,
               [](const Row& r) {
                 return std::array{r.summary.mean_reward, r.intervals.mean_reward.low, r.intervals.mean_reward.high};
               }) +
         "unset multiplot\n";
}

}  // namespace earshot::evaluate
