#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sim/search/episode/episode.hpp"

namespace earshot::evaluate {

/// Where searches went, for a page: of each policy in each world the first kMost, whole. Rounded to 10 m and 0.1 dB.
class SearchesJson {
 public:
  static constexpr std::size_t kMost = 50;

  /// A search's start, or the end of a step; those of one search follow each other. @param end  how the search stands there
  void add(std::string_view world, std::string_view policy, std::size_t number, const search::Episode& episode, search::EpisodeEnd end);
  /// An array of `Search` (policy/report/page/source/suite.ts).
  [[nodiscard]] const nlohmann::ordered_json& json() const { return searches_; }

 private:
  nlohmann::ordered_json searches_ = nlohmann::ordered_json::array();
};

}  // namespace earshot::evaluate
