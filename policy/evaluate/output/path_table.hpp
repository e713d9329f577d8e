#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "sim/search/episode/episode.hpp"

namespace earshot::evaluate {

/// "running", "found", "left_domain", "time_limit"
[[nodiscard]] std::string_view name_of(search::EpisodeEnd end);

/// The paths of searches as CSV: a row for every start and for the end of every step.
class PathTable {
 public:
  PathTable();
  /// @param end  how the search stands there
  void add(std::string_view world, std::string_view policy, std::size_t number, const search::Episode& episode, search::EpisodeEnd end);
  [[nodiscard]] const std::string& csv() const { return csv_; }

 private:
  std::string csv_;
};

}  // namespace earshot::evaluate
