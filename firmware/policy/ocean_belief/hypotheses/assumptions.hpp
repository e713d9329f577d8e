#pragma once

#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// What a belief assumes for the length of one call: the model of the search, and the oceans that are possible. It owns neither.
struct Assumptions {
  const BeliefModel& model;
  const OceanTables& tables;
};

}  // namespace earshot::policy
