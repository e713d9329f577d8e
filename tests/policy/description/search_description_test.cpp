#include "policy/description/search_description.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/belief_model.hpp"

namespace earshot::description {
namespace {

SearchDescription with_belief() {
  search::SearchSettings settings;
  settings.border_reward = -40.0;
  policy::ObservationModel observation;
  observation.belief = search::belief_model(settings);
  observation.belief.costs.step = 2.5F;
  observation.spec = policy::belief_state(observation.belief);
  return describe(settings, observation);
}

TEST(SearchDescription, CarriesWhatASearchCosts) {
  const policy::BeliefCosts costs = from_text(to_text(with_belief())).observation.belief.costs;
  EXPECT_EQ(costs.edge, 40.0F);
  EXPECT_EQ(costs, with_belief().observation.belief.costs);
}

TEST(SearchDescription, CarriesTheGridAndTheOutliersOfABelief) {
  SearchDescription written = with_belief();
  written.observation.belief.cells_north = 40;
  written.observation.belief.cells_east = 37;
  written.observation.belief.border_width = Meters{750.0};
  written.observation.belief.outlier_share = 0.25F;
  const policy::BeliefModel read = from_text(to_text(written)).observation.belief;
  EXPECT_EQ(read.cells_north, 40);
  EXPECT_EQ(read.cells_east, 37);
  EXPECT_EQ(read.border_width, Meters{750.0});
  EXPECT_EQ(read.outlier_share, 0.25F);
}

TEST(SearchDescription, OfABeliefInASingleOceanIsRefusedAndSaysWhereOceansAreNow) {
  std::string text = to_text(with_belief());
  text.insert(text.find("\"cells_north\""), "\"snr_db\":[30.0,20.0],\"range_step_m\":100.0,");
  try {
    (void)from_text(text);
    ADD_FAILURE() << "accepted";
  } catch (const host::BadInput& bad) {
    EXPECT_NE(std::string(bad.what()).find("ocean tables; train it again"), std::string::npos) << bad.what();
  }
}

TEST(SearchDescription, IsRefusedForACostOutOfItsRange) {
  std::string text = to_text(with_belief());
  text.replace(text.find("\"edge\":40"), 9, "\"edge\":-4");
  EXPECT_THROW((void)from_text(text), host::BadInput);
}

}  // namespace
}  // namespace earshot::description
