#include "policy/evaluate/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace earshot::evaluate {
namespace {

std::vector<Flight> flights() {
  std::vector<Flight> all(4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].record = {.reward = -1.0 * static_cast<double>(i), .steps = 10, .detections = 5, .end = search::EpisodeEnd::kTimeLimit};
    all[i].decision_s = 10 * 3e-6;
  }
  return all;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

std::string value_of(const std::string& csv, const std::string& column) {
  std::istringstream stream(csv);
  std::string header;
  std::string line;
  std::getline(stream, header);
  std::getline(stream, line);
  const std::vector<std::string> names = cells_of(header);
  const std::vector<std::string> values = cells_of(line);
  EXPECT_EQ(names.size(), values.size());
  const auto place = std::ranges::find(names, column);
  return place == names.end() ? "no such column" : values[static_cast<std::size_t>(place - names.begin())];
}

TEST(Table, WritesEveryFigureUnderItsName) {
  const std::vector<Row> rows{row_of("sea", "guess", flights(), 1)};
  const std::string csv = as_csv(rows, Timing::kIncluded);
  EXPECT_EQ(value_of(csv, "world"), "sea");
  EXPECT_EQ(value_of(csv, "policy"), "guess");
  EXPECT_EQ(value_of(csv, "episodes"), "4");
  EXPECT_EQ(value_of(csv, "mean_reward"), "-1.5");
  EXPECT_EQ(value_of(csv, "median_reward"), "-1.5");
  EXPECT_EQ(value_of(csv, "lower_quartile_reward"), "-2.25");
  EXPECT_EQ(value_of(csv, "found_fraction"), "0");
  EXPECT_EQ(value_of(csv, "mean_steps"), "10");
  EXPECT_EQ(value_of(csv, "mean_detections"), "5");
  EXPECT_EQ(value_of(csv, "path_over_straight"), "") << "none found the source";
  EXPECT_NEAR(std::stod(value_of(csv, "decision_us")), 3.0, 1e-9);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(TablePlot, StandsItsPanelsOverOneAnotherWithOneLegendAndAMarkForEachPolicy) {
  std::vector<Row> rows;
  for (const char* world : {"calm", "noisy"}) {
    for (const char* policy : {"shipped", "bayes"}) rows.push_back(row_of(world, policy, flights(), 1));
  }
  const std::string plot = as_plot(rows, "4 searches each in 2 worlds");
  EXPECT_EQ(count(plot, "set lmargin at screen"), 1U) << "both panels begin at the same place";
  EXPECT_EQ(count(plot, "set rmargin at screen"), 1U) << "and end there";
  EXPECT_EQ(count(plot, "title 'shipped'"), 1U);
  EXPECT_EQ(count(plot, "'calm' 0"), 1U) << "places are named once, below both";
  EXPECT_NE(plot.find("pt 7 ps 1.1 lw 1.5 lc rgb '#1b6ca8' title 'shipped'"), std::string::npos) << plot;
  EXPECT_NE(plot.find("pt 5 ps 1.1 lw 1.5 lc rgb '#d1495b' title 'bayes'"), std::string::npos) << "another shape, not only another colour";
}

TEST(TablePlot, OfOneWorldNamesPoliciesAlongTheAxisAndHasNoLegend) {
  const std::string plot = as_plot(std::vector<Row>{row_of("calm", "shipped", flights(), 1), row_of("calm", "bayes", flights(), 1)}, "one");
  EXPECT_EQ(count(plot, "'shipped' 0, 'bayes' 1"), 1U);
  EXPECT_EQ(count(plot, " title 'calm'"), 0U);
}

TEST(Table, KeepsNamesWithCommasAndQuotesInTheirCells) {
  const std::string csv = as_csv(std::vector<Row>{row_of("deep, cold", R"(a"b)", flights(), 1)}, Timing::kLeftOut);
  EXPECT_NE(csv.find("\n\"deep, cold\",\"a\"\"b\",4,-1.5,"), std::string::npos) << csv;
}

TEST(Table, LeavesOutTheClockSoThatItsBytesRepeat) {
  std::vector<Flight> slower = flights();
  for (Flight& flight : slower) flight.decision_s *= 2.0;
  const std::vector<Row> a{row_of("sea", "guess", flights(), 1)};
  const std::vector<Row> b{row_of("sea", "guess", slower, 1)};
  EXPECT_EQ(as_csv(a, Timing::kLeftOut), as_csv(b, Timing::kLeftOut));
  EXPECT_NE(as_csv(a, Timing::kIncluded), as_csv(b, Timing::kIncluded));
}

TEST(Table, HasALineForEveryPolicy) {
  const std::vector<Row> rows{row_of("sea", "guess", flights(), 1), row_of("sea", "a policy with a rather long name", flights(), 1)};
  const std::string text = as_text(rows);
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_NE(text.find("a policy with a rather long name"), std::string::npos);
}

}  // namespace
}  // namespace earshot::evaluate
