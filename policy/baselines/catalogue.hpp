#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

struct Entry {
  std::string_view name;
  std::string_view what;            ///< in a few words
  bool is_given_the_ocean = false;  ///< its belief is of one ocean that it is told; a vehicle has to find out which one it is
};

/// Every searcher that is not learned.
[[nodiscard]] std::span<const Entry> catalogue();

/// The baseline of that name; null when there is none. @param prior  outlives it
[[nodiscard]] std::unique_ptr<Searcher> make_baseline(std::string_view name, const PriorKnowledge& prior);

}  // namespace earshot::baselines
