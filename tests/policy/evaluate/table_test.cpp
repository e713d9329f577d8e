#include "policy/evaluate/output/table.hpp"
#include "policy/evaluate/output/table_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

std::vector<Flight> flights() {
  std::vector<Flight> all(4);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].record = {.reward = -1.0 * static_cast<double>(i), .steps = 10, .detections = 5, .end = search::EpisodeEnd::kTimeLimit};
    all[i].decision_s = 10 * 3e-6;
    all[i].refinement_s = 10 * 40e-6;
  }
  return all;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
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
  const std::vector<Row> rows{row_of("sea", "guess", flights(), {}, 1)};
  const std::string csv = as_csv(rows, Timing::kIncluded);
  EXPECT_EQ(value_of(csv, "world"), "sea");
  EXPECT_EQ(value_of(csv, "policy"), "guess");
  EXPECT_EQ(value_of(csv, "episodes"), "4");
  EXPECT_EQ(value_of(csv, "mean_reward"), "-1.5");
  EXPECT_EQ(value_of(csv, "median_reward"), "-1.5");
  EXPECT_EQ(value_of(csv, "lower_quartile_reward"), "-2.25");
  EXPECT_EQ(value_of(csv, "found_fraction"), "0");
  EXPECT_EQ(value_of(csv, "found_fraction_low"), "0");
  EXPECT_NEAR(std::stod(value_of(csv, "found_fraction_high")), 0.6024, 5e-5);  // 1 - 0.025^(1/4)
  EXPECT_EQ(value_of(csv, "median_hours_to_find"), "inf") << "none found";
  EXPECT_EQ(value_of(csv, "restricted_mean_steps_to_find"), "100");
  EXPECT_EQ(value_of(csv, "mean_steps"), "10");
  EXPECT_EQ(value_of(csv, "mean_detections"), "5");
  EXPECT_EQ(value_of(csv, "path_over_straight"), "") << "none found the source";
  EXPECT_NEAR(std::stod(value_of(csv, "decision_us")), 3.0, 1e-9);
  EXPECT_NEAR(std::stod(value_of(csv, "pondering_us")), 40.0, 1e-9);
}

TEST(Table, SaysHowOftenTheSourceWasDeclaredFoundWronglyOfThoseWhoDeclareIt) {
  std::vector<Flight> all = flights();
  const std::vector<Row> silent{row_of("sea", "guess", all, {}, 1)};
  EXPECT_EQ(value_of(as_csv(silent, Timing::kLeftOut), "missed_fraction"), "");
  EXPECT_EQ(as_text(silent).find("declared"), std::string::npos);
  all[0].declarations = Declarations{.was_within = true, .rightly = true, .falsely = true};
  all[1].declarations = Declarations{.was_within = true};
  all[2].declarations = Declarations{.falsely = true, .far_off = true};
  all[3].declarations = Declarations{.falsely = true};
  std::vector<Row> rows{row_of("sea", "guess", all, {}, 1)};
  const std::string csv = as_csv(rows, Timing::kLeftOut);
  EXPECT_EQ(value_of(csv, "declared_falsely_fraction"), "0.75");
  EXPECT_EQ(value_of(csv, "declared_far_off_fraction"), "0.25");
  EXPECT_EQ(value_of(csv, "missed_fraction"), "0.5") << "of the two that came near";
  // 3 of 4 declared falsely, 1 of 4 far off, 1 of the 2 that came near declared nothing there.
  EXPECT_NE(as_text(rows).find("guess                  75.0         25.0      50.0\n"), std::string::npos) << as_text(rows);
  all[0].declarations->was_within = all[1].declarations->was_within = false;
  rows = {row_of("sea", "guess", all, {}, 1)};
  EXPECT_NE(as_text(rows).find("guess                  75.0         25.0         -\n"), std::string::npos) << "none came near";
}

TEST(Table, ListsThoseAloneThatDeclareTheSourceFoundAndSaysWhatItsWordsMean) {
  std::vector<Flight> declaring = flights();
  for (Flight& flight : declaring) flight.declarations = Declarations{.was_within = true};
  const std::string text = as_text(std::vector<Row>{row_of("sea", "guess", flights(), {}, 1), row_of("sea", "sure", declaring, {}, 1)});
  EXPECT_EQ(count(text, "\nguess "), 3U) << text;
  EXPECT_EQ(count(text, "\nsure "), 4U) << text;
  EXPECT_TRUE(support::has_line(text, {"falsely:", "further than one step length", "far off:", "1.5"}));
  EXPECT_TRUE(support::has_line(text, {"missed:", "came within one step length"}));
}

/// The columns of a header of two lines, each with both of its lines: "left area %". Two columns are two blanks apart in both lines.
void add_columns(std::string above, std::string below, std::vector<std::string>& names) {
  const std::size_t width = std::max(above.size(), below.size()) + 2;
  above.resize(width, ' ');
  below.resize(width, ' ');
  const auto is_blank = [&](std::size_t i) { return above[i] == ' ' && below[i] == ' '; };
  const auto trimmed = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
  };
  for (std::size_t begin = 0, i = 0; i + 1 < width; ++i) {
    if (!is_blank(i) || !is_blank(i + 1)) continue;
    const std::string name = trimmed(trimmed(above.substr(begin, i - begin)) + " " + trimmed(below.substr(begin, i - begin)));
    if (!name.empty() && name != "policy") names.push_back(name);
    begin = i + 1;
  }
}

/// Of a table in text: every header begins with "policy".
std::vector<std::string> columns_of_text(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string above, below; std::getline(stream, above);) {
    if (above.starts_with("policy") && std::getline(stream, below)) add_columns(above, below, names);
  }
  return names;
}

/// Of the table below "What the columns mean": "| found % | ... |".
std::vector<std::string> columns_of_readme() {
  std::ifstream stream(std::string(EARSHOT_SOURCE_DIR) + "/policy/evaluate/README.md");
  std::vector<std::string> names;
  bool is_there = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("## ")) is_there = line == "## What the columns mean";
    if (is_there && line.starts_with("| `")) names.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  return names;
}

TEST(Table, HasTheColumnsThatTheReadmeExplains) {
  std::vector<Flight> all = flights();
  for (Flight& flight : all) flight.declarations = Declarations{};
  EXPECT_EQ(columns_of_text(as_text(std::vector<Row>{row_of("sea", "guess", all, {}, 1)})), columns_of_readme());
}

TEST(Table, GivesTheShareOfSearchesMismatchedAndTheirMedianMeasurementOrNothingWhereNobodyJudgesIt) {
  std::vector<Flight> all = flights();
  const Row unjudged = row_of("sea", "guess", all, {}, 1);
  EXPECT_EQ(value_of(as_csv(std::vector<Row>{unjudged}, Timing::kLeftOut), "surprised_fraction"), "");
  for (Flight& flight : all) flight.measurements_to_mismatch = std::numeric_limits<double>::infinity();
  all[2].measurements_to_mismatch = 12.0;
  const std::vector<Row> judged{row_of("sea", "guess", all, {}, 1)};
  const std::string csv = as_csv(judged, Timing::kLeftOut);
  EXPECT_EQ(value_of(csv, "surprised_fraction"), "0.25");
  EXPECT_EQ(value_of(csv, "median_look_of_surprise"), "12");
  EXPECT_NE(as_text(judged).find("      5.0     25.00   12.00      3.00      40.00\n"), std::string::npos) << as_text(judged);
  EXPECT_NE(as_text(std::vector<Row>{unjudged}).find("      5.0         -       -      3.00      40.00\n"), std::string::npos)
      << as_text(std::vector<Row>{unjudged});
}

/// Three of four found, after 36, 72 and 18 steps.
std::vector<Flight> mostly_found() {
  std::vector<Flight> all = flights();
  for (const auto& [i, steps] : {std::pair{0U, 36U}, std::pair{1U, 72U}, std::pair{3U, 18U}}) {
    all[i].record.steps = steps;
    all[i].record.end = search::EpisodeEnd::kFound;
  }
  return all;
}

TEST(Table, GivesTimesInStepsAndInHoursOfAStepsLength) {
  const std::string csv =
      as_csv(std::vector<Row>{row_of("sea", "guess", mostly_found(), {.step_s = 100.0, .max_steps = 90}, 1)}, Timing::kLeftOut);
  EXPECT_EQ(value_of(csv, "found_fraction"), "0.75");
  EXPECT_EQ(value_of(csv, "lower_quartile_steps_to_find"), "18");
  EXPECT_EQ(value_of(csv, "median_steps_to_find"), "36");
  EXPECT_EQ(value_of(csv, "upper_quartile_steps_to_find"), "72");
  EXPECT_EQ(value_of(csv, "lower_quartile_hours_to_find"), "0.5");
  EXPECT_EQ(value_of(csv, "median_hours_to_find"), "1");
  EXPECT_EQ(value_of(csv, "upper_quartile_hours_to_find"), "2");
  EXPECT_EQ(value_of(csv, "restricted_mean_steps_to_find"), "54");  // (36 + 72 + 90 + 18) / 4
  EXPECT_EQ(value_of(csv, "restricted_mean_hours_to_find"), "1.5");
}

TEST(Table, LeadsWithFoundThenTimeThenReward) {
  const Row row = row_of("sea", "guess", mostly_found(), {.step_s = 100.0, .max_steps = 90}, 1);
  const std::string csv = as_csv(std::vector<Row>{row}, Timing::kLeftOut);
  EXPECT_TRUE(csv.starts_with("world,policy,episodes,found_fraction,"));
  EXPECT_LT(csv.find("median_hours_to_find"), csv.find("mean_reward"));
  const std::string text = as_text(std::vector<Row>{row});
  EXPECT_LT(text.find("found"), text.find("to find"));
  EXPECT_LT(text.find("to find"), text.find("reward"));
  // By hand: 3 of 4, Clopper and Pearson's 19.41 to 99.37 %; then median and quartiles.
  EXPECT_NE(text.find("guess              75.0   19.4 to  99.4    1.00   0.50 to  2.00   1.50  "), std::string::npos) << text;
  const std::string plot = as_plot(std::vector<Row>{row}, "one");
  EXPECT_LT(plot.find("sources found"), plot.find("hours to find"));
  EXPECT_LT(plot.find("hours to find"), plot.find("mean reward"));
}

TEST(Table, ShowsADashForATimeThatNeverComes) {
  const std::string text = as_text(std::vector<Row>{row_of("sea", "guess", flights(), {}, 1)});
  EXPECT_NE(text.find("guess               0.0    0.0 to  60.2       -      - to     -  13.89  13.89 to 13.89"), std::string::npos) << text;
}

TEST(TablePlot, StandsItsPanelsOverOneAnotherWithOneLegendAndAMarkForEachPolicy) {
  std::vector<Row> rows;
  for (const char* world : {"calm", "noisy"}) {
    for (const char* policy : {"shipped", "bayes"}) rows.push_back(row_of(world, policy, flights(), {}, 1));
  }
  const std::string plot = as_plot(rows, "4 searches each in 2 worlds");
  EXPECT_EQ(count(plot, "set lmargin at screen"), 1U) << "all panels begin at the same place";
  EXPECT_EQ(count(plot, "set rmargin at screen"), 1U) << "and end there";
  EXPECT_EQ(count(plot, "title 'shipped'"), 1U);
  EXPECT_EQ(count(plot, "'calm' 0"), 1U) << "places are named once, below all";
  EXPECT_NE(plot.find("pt 7 ps 1.1 lw 1.5 lc rgb '#1b6ca8' title 'shipped'"), std::string::npos) << plot;
  EXPECT_NE(plot.find("pt 5 ps 1.1 lw 1.5 lc rgb '#d1495b' title 'bayes'"), std::string::npos) << "another shape, not only another colour";
}

TEST(TablePlot, OfOneWorldNamesPoliciesAlongTheAxisAndHasNoLegend) {
  const std::string plot =
      as_plot(std::vector<Row>{row_of("calm", "shipped", flights(), {}, 1), row_of("calm", "bayes", flights(), {}, 1)}, "one");
  EXPECT_EQ(count(plot, "'shipped' 0, 'bayes' 1"), 1U);
  EXPECT_EQ(count(plot, " title 'calm'"), 0U);
}

TEST(Table, KeepsNamesWithCommasAndQuotesInTheirCells) {
  const std::string csv = as_csv(std::vector<Row>{row_of("deep, cold", R"(a"b)", flights(), {}, 1)}, Timing::kLeftOut);
  EXPECT_NE(csv.find("\n\"deep, cold\",\"a\"\"b\",4,0,"), std::string::npos) << csv;
}

TEST(Table, LeavesOutTheClockSoThatItsBytesRepeat) {
  std::vector<Flight> slower = flights();
  for (Flight& flight : slower) flight.decision_s *= 2.0;
  const std::vector<Row> a{row_of("sea", "guess", flights(), {}, 1)};
  const std::vector<Row> b{row_of("sea", "guess", slower, {}, 1)};
  EXPECT_EQ(as_csv(a, Timing::kLeftOut), as_csv(b, Timing::kLeftOut));
  EXPECT_NE(as_csv(a, Timing::kIncluded), as_csv(b, Timing::kIncluded));
}

TEST(Table, HasALineForEveryPolicy) {
  const std::vector<Row> rows{row_of("sea", "guess", flights(), {}, 1),
                              row_of("sea", "a policy with a rather long name", flights(), {}, 1)};
  const std::string text = as_text(rows);
  EXPECT_EQ(std::ranges::count(text, '\n'), 3 * 4 + 3)
      << "three tables of a header of two lines and two rows; the long name on lines of its own";
  EXPECT_EQ(count(text, "\na policy with a rather long name\n"), 3U);
}

TEST(Table, IsNoWiderThanAHundredColumnsHoweverLongANameIs) {
  std::vector<Flight> all = mostly_found();
  for (Flight& flight : all) {
    flight.record.reward = -9'999.0;
    flight.record.detections = 100;
    flight.decision_s = flight.refinement_s = 10.0;
    flight.measurements_to_mismatch = 100.0;
  }
  const std::vector<Row> rows{row_of("sea", std::string(120, 'a'), all, {.step_s = 5'000.0, .max_steps = 100}, 1),
                              row_of("sea", std::string(28, 'b'), all, {.step_s = 5'000.0, .max_steps = 100}, 1)};
  std::istringstream text(as_text(rows));
  for (std::string line; std::getline(text, line);) {
    if (line == rows[0].policy) continue;
    EXPECT_LE(line.size(), 100U) << line;
  }
}

TEST(TablePlot, IsNotRuledByAnOutlierWhichStandsAtItsEdgeWithItsNumber) {
  std::vector<Row> rows;
  const auto add = [&rows](const std::string& world, const std::string& policy, double reward) {
    std::vector<Flight> all = flights();
    for (Flight& flight : all) flight.record.reward = reward;
    rows.push_back(row_of(world, policy, all, {}, 1));
  };
  for (int i = 0; i < 6; ++i) {
    add("w" + std::to_string(i), "shipped", -10.0 - i);
    add("w" + std::to_string(i), "infotaxis", i == 3 ? -2'500.0 : -20.0 - i);
  }
  const std::string plot = as_plot(rows, "six worlds");
  EXPECT_NE(plot.find("set yrange [-26.25:0]\n"), std::string::npos) << "1.05 times the lowest of the others, -25\n" << plot;
  // The second of two policies, 0.35 apart from the first, in the fourth world: 3 + 0.35 / 2.
  EXPECT_NE(plot.find("set label '-2500.0' at first 3.175, graph 0.03"), std::string::npos) << plot;
  EXPECT_EQ(count(plot, "set label '"), 1U);
  rows[0].intervals.mean_reward.low = -1'234.5;  // an interval that the axis cuts says how far it goes: 0 - 0.35 / 2
  rows[2].intervals.mean_reward.low = -26.0;
  const std::string cut = as_plot(rows, "six worlds");
  EXPECT_NE(cut.find("set label 'to -1234.5' at first -0.175, graph 0.03"), std::string::npos) << cut;
  EXPECT_EQ(count(cut, "set label 'to "), 1U);
  rows.erase(rows.begin() + 7);
  EXPECT_EQ(count(as_plot(rows, "none"), "set label '"), 0U);
}

}  // namespace
}  // namespace earshot::evaluate
