#pragma once

#include <filesystem>
#include <vector>

#include "sim/ocean/environment.hpp"
#include "sim/search/scenario/conditions.hpp"

namespace earshot::search {

/// What an environment file says of a search: the ocean it believes itself in, those it may truly be in, and what disturbs it.
struct Scenario {
  ocean::Environment environment;                     ///< the file's own ocean and source; its CRC covers all that the file names
  std::vector<ocean::Environment> other_oceans = {};  ///< a search is in `environment` or one of these, each as likely as another
  std::filesystem::path field_library = {};  ///< transmission loss computed beforehand, instead of the environment's own; empty: none
  Conditions conditions = {};
};

}  // namespace earshot::search
