#include "policy/description/trained_task.hpp"

#include <gtest/gtest.h>

namespace earshot::description {
namespace {

using search::SourcePlacement;
using search::StartPlacement;

TEST(TrainedTask, IsReadFromTheLinesOfItsNames) {
  const TrainedTask task = trained_task(
      "command = earshot-train --source changing --max-steps 7\nenvironment = munk_flat.toml\nenvironment_crc32 = 5c0a141c\n"
      "source_north_m = 10000\nsource_east_m = -2.5\nvehicle_depth_m = 250\nstate = simple\nsource = fixed\nstart_margin_m = 0\n"
      "border_width_m = 500\nborder_reward = -40\nmax_steps = 60\nseed = 1");
  EXPECT_EQ(task.source, SourcePlacement::kFixed);
  EXPECT_EQ(task.source_position, (NorthEast{Meters{10'000.0}, Meters{-2.5}}));
  EXPECT_EQ(task.start_margin, Meters{0.0});
  EXPECT_EQ(task.start, std::nullopt);
  EXPECT_EQ(task.border_width, Meters{500.0});
  EXPECT_EQ(task.border_reward, -40.0);
  EXPECT_EQ(task.max_steps, 60U);
  EXPECT_EQ(task.vehicle_depth, Meters{250.0});
  EXPECT_EQ(task.environment, "munk_flat.toml");
  EXPECT_EQ(task.environment_crc32, "5c0a141c");
}

TEST(TrainedTask, KnowsItsStartsByNameWhereAPolicyWasTrainedInPython) {
  const TrainedTask task = trained_task("state = memory\nsource = changing\nstart = inside_border\n");
  EXPECT_EQ(task.source, SourcePlacement::kChanging);
  EXPECT_EQ(task.start, StartPlacement::kInsideBorder);
  EXPECT_EQ(task.start_margin, std::nullopt);
}

TEST(TrainedTask, IsNotGuessedWhereTheProvenanceDoesNotSay) {
  for (const char* provenance : {"", "command = earshot-train --source fixed\nresource = fixed\n", "source = drifting\nstart = \n",
                                 "start_margin_m = -1\nborder_width_m = 1e3m\nvehicle_depth_m = inf\nborder_reward = nan\n",
                                 "max_steps = 0\nborder_width_m = 0\nvehicle_depth_m = 0\n", "max_steps = 1.5\n", "source_north_m = 1\n",
                                 "max_steps=3\nsource=fixed\n"}) {
    const TrainedTask task = trained_task(provenance);
    EXPECT_EQ(task.source, std::nullopt) << provenance;
    EXPECT_EQ(task.source_position, std::nullopt) << provenance;
    EXPECT_EQ(task.start, std::nullopt) << provenance;
    EXPECT_EQ(task.start_margin, std::nullopt) << provenance;
    EXPECT_EQ(task.border_width, std::nullopt) << provenance;
    EXPECT_EQ(task.border_reward, std::nullopt) << provenance;
    EXPECT_EQ(task.max_steps, std::nullopt) << provenance;
    EXPECT_EQ(task.vehicle_depth, std::nullopt) << provenance;
    EXPECT_EQ(task.environment, "") << provenance;
  }
}

TrainedTask read_back(const search::SearchSettings& settings, Meters vehicle_depth) {
  std::string provenance;
  for (const auto& [name, value] : task_lines(settings, vehicle_depth)) provenance += name + " = " + value + "\n";
  return trained_task(provenance);
}

TEST(TrainedTask, ReadsWhatIsWrittenOfASearch) {
  search::SearchSettings settings;
  settings.source = {Meters{1.0 / 3.0}, Meters{20'000.0}};
  settings.start_region = settings.domain.moved_in(Meters{7'500.0});
  settings.border_width = Meters{500.5};
  settings.border_reward = -1.25;
  settings.max_steps = 1'000'000;
  const TrainedTask task = read_back(settings, Meters{299.0});
  EXPECT_EQ(task.source, SourcePlacement::kFixed);
  EXPECT_EQ(task.source_position, settings.source);
  EXPECT_EQ(task.start_margin, Meters{7'500.0});
  EXPECT_EQ(task.border_width, settings.border_width);
  EXPECT_EQ(task.border_reward, settings.border_reward);
  EXPECT_EQ(task.max_steps, settings.max_steps);
  EXPECT_EQ(task.vehicle_depth, Meters{299.0});
  settings.placement = SourcePlacement::kChanging;
  EXPECT_EQ(read_back(settings, Meters{299.0}).source, SourcePlacement::kChanging);
  EXPECT_EQ(read_back(settings, Meters{299.0}).source_position, std::nullopt) << "it has none";
}

}  // namespace
}  // namespace earshot::description
