#include "policy/training/curve_plot.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/training/learning_curve.hpp"
#include "sim/plot/gnuplot.hpp"

namespace earshot::training {
namespace {

constexpr std::size_t kPoints = 500;  // more than a picture shows

std::vector<double> rewards_in(std::string_view csv) {
  std::vector<double> rewards;
  csv.remove_prefix(kEpisodesHeader.size());
  for (EpisodeRow row; take_row(csv, row);) rewards.push_back(row.reward);
  return rewards;
}

std::array<double, 3> quartiles(const std::vector<double>& values) {
  return {evaluate::quantile(values, 0.25), evaluate::quantile(values, 0.5), evaluate::quantile(values, 0.75)};
}

/// Quartiles of the last kRecentEpisodes before `end`.
std::array<double, 3> recent_quartiles(const std::vector<double>& rewards, std::size_t end) {
  const auto begin = static_cast<std::ptrdiff_t>(end - std::min(end, kRecentEpisodes));
  return quartiles({rewards.begin() + begin, rewards.begin() + static_cast<std::ptrdiff_t>(end)});
}

}  // namespace

std::vector<CurvePoint> points_of(std::span<const std::string> episodes_csv) {
  std::vector<std::vector<double>> rewards;
  std::size_t shortest = std::numeric_limits<std::size_t>::max();
  for (const std::string& csv : episodes_csv) {
    rewards.push_back(rewards_in(csv));
    shortest = std::min(shortest, rewards.back().size());
  }
  std::vector<CurvePoint> points;
  const std::size_t stride = std::max<std::size_t>(1, shortest / kPoints);
  for (std::size_t end = stride; end <= shortest; end += stride) {
    std::vector<double> medians;
    for (const auto& each : rewards) medians.push_back(recent_quartiles(each, end)[1]);
    const auto [lower, median, upper] = rewards.size() == 1 ? recent_quartiles(rewards.front(), end) : quartiles(medians);
    points.push_back({end, lower, median, upper});
  }
  return points;
}

void draw_curves(const std::filesystem::path& path, const std::string& title, std::span<const std::string> episodes_csv) {
  const std::vector<CurvePoint> points = points_of(episodes_csv);
  if (points.empty()) throw host::BadInput(path.string() + ": no episode has ended in every training, nothing to draw");
  std::ostringstream commands;
  commands << "$points << EOD\n";
  for (const CurvePoint& p : points) commands << p.episode << ' ' << p.lower << ' ' << p.median << ' ' << p.upper << '\n';
  const bool several = episodes_csv.size() > 1;
  const std::string band =
      several ? "quartiles of " + std::to_string(episodes_csv.size()) + " trainings" : "quartiles of the last 50 episodes";
  const std::string line = several ? "median of their medians of the last 50 episodes" : "median of the last 50 episodes";
  commands << "EOD\nset title " << plot::quoted(title) << " noenhanced\nset xlabel 'episodes'\nset ylabel 'reward of an episode'\n"
           << "set key bottom right reverse Left\nset tics out nomirror\nset grid\nset style fill solid\nset autoscale xfix\n"
           << "plot $points using 1:2:4 with filledcurves fillcolor rgb '#b0c8e8' title " << plot::quoted(band)
           << ", $points using 1:3 with lines linewidth 2 linecolor rgb '#104080' title " << plot::quoted(line) << "\n";
  try {
    plot::draw(path, {.title = title, .size = "900,500", .commands = commands.str()});
  } catch (const std::runtime_error& e) {
    throw host::BadInput(e.what());
  }
}

}  // namespace earshot::training
