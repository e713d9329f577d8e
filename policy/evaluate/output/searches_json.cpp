#include "policy/evaluate/output/searches_json.hpp"

#include <cmath>
#include <cstdint>

#include "policy/evaluate/output/path_table.hpp"

namespace earshot::evaluate {
namespace {

using Json = nlohmann::ordered_json;

bool is_of(const Json& search, std::string_view world, std::string_view policy, std::size_t number) {
  return search["number"] == number && search["policy"] == policy && search["world"] == world;
}

}  // namespace

void SearchesJson::add(std::string_view world, std::string_view policy, std::size_t number, const search::Episode& episode,
                       search::EpisodeEnd end) {
  if (number >= kMost) return;
  if (searches_.empty() || !is_of(searches_.back(), world, policy, number))
    searches_.push_back({{"world", world}, {"policy", policy}, {"number", number}});
  constexpr double kPlace_m = 10.0;
  const auto place = [](double value_m) { return static_cast<std::int64_t>(std::round(value_m / kPlace_m) * kPlace_m); };
  Json& search = searches_.back();
  search["end"] = name_of(end);
  search["reward"] = std::round(episode.record().reward * 100.0) / 100.0;
  search["source"] = {{"north_m", place(episode.source().north.value)}, {"east_m", place(episode.source().east.value)}};
  search["north_m"].push_back(place(episode.position().north.value));
  search["east_m"].push_back(place(episode.position().east.value));
  search["snr_db"].push_back(std::round(episode.snr().value * 10.0) / 10.0);
}

}  // namespace earshot::evaluate
