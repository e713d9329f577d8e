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
  observation.belief = search::belief_model(settings, sonar::SnrCurve(Meters{10.0}, {30.0F, 20.0F}));
  observation.belief.costs.step = 2.5F;
  observation.spec = policy::belief_state(observation.belief);
  return describe(settings, observation);
}

TEST(SearchDescription, CarriesWhatASearchCosts) {
  const policy::BeliefCosts costs = from_text(to_text(with_belief())).observation.belief.costs;
  EXPECT_EQ(costs.edge, 40.0F);
  EXPECT_EQ(costs, with_belief().observation.belief.costs);
}

/// The text without what stands from `begin` to the next '}' and the comma behind it.
std::string without(std::string text, const std::string& begin) {
  const std::size_t at = text.find(begin);
  return text.erase(at, text.find('}', at) + 2 - at);
}

TEST(SearchDescription, OfATimeWhenCostsCouldNotDifferHasTheDefaults) {
  EXPECT_EQ(from_text(without(to_text(with_belief()), "\"costs\":")).observation.belief.costs, policy::BeliefCosts{});
}

TEST(SearchDescription, IsRefusedForACostOutOfItsRange) {
  std::string text = to_text(with_belief());
  text.replace(text.find("\"edge\":40"), 9, "\"edge\":-4");
  EXPECT_THROW((void)from_text(text), host::BadInput);
}

}  // namespace
}  // namespace earshot::description
