#include "policy/description/element_names.hpp"

namespace earshot::description {
namespace {

using policy::Feature;

std::string name_of(Feature feature) {
  switch (feature) {
    case Feature::kEast:
      return "east";
    case Feature::kNorth:
      return "north";
    case Feature::kStepEast:
      return "step_east";
    case Feature::kStepNorth:
      return "step_north";
    case Feature::kStepSnr:
      return "step_snr";
    case Feature::kToSouthEdge:
      return "to_south_edge";
    case Feature::kToNorthEdge:
      return "to_north_edge";
    case Feature::kToWestEdge:
      return "to_west_edge";
    case Feature::kToEastEdge:
      return "to_east_edge";
    case Feature::kLikeliestEast:
      return "likeliest_east";
    case Feature::kLikeliestNorth:
      return "likeliest_north";
    case Feature::kMeanEast:
      return "mean_east";
    case Feature::kMeanNorth:
      return "mean_north";
    case Feature::kSpread:
      return "spread";
    case Feature::kLikeliestShare:
      return "likeliest_share";
    case Feature::kEffectiveCells:
      return "effective_cells";
    case Feature::kFound:
      return "found";
    case Feature::kFindProbability:
      return "find_probability";
    case Feature::kDetected:
      return "detected";
    case Feature::kBorder:
      return "border";
    case Feature::kRegret:
      return "regret";
    case Feature::kPreference:
      return "preference";
    case Feature::kApproach:
      return "approach";
  }
  return "unknown";
}

bool is_one_of_several(Feature feature) {
  return (feature >= Feature::kStepEast && feature <= Feature::kStepSnr) || feature >= Feature::kFound;
}

}  // namespace

std::vector<std::string> element_names(const policy::ObservationSpec& spec) {
  std::vector<std::string> names;
  for (const policy::ObservationElement& element : spec)
    names.push_back(name_of(element.feature) + (is_one_of_several(element.feature) ? "_" + std::to_string(element.age) : ""));
  return names;
}

}  // namespace earshot::description
