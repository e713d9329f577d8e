#include "policy/evaluate/output/path_table.hpp"

#include <sstream>

#include "policy/evaluate/output/csv.hpp"

namespace earshot::evaluate {
std::string_view name_of(search::EpisodeEnd end) {
  switch (end) {
    case search::EpisodeEnd::kRunning:
      return "running";
    case search::EpisodeEnd::kFound:
      return "found";
    case search::EpisodeEnd::kLeftDomain:
      return "left_domain";
    case search::EpisodeEnd::kTimeLimit:
      return "time_limit";
  }
  return "";
}

PathTable::PathTable() : csv_("world,policy,episode,step,north_m,east_m,snr_db,reward_so_far,source_north_m,source_east_m,state\n") {}

void PathTable::add(std::string_view world, std::string_view policy, std::size_t number, const search::Episode& episode,
                    search::EpisodeEnd end) {
  const search::EpisodeRecord& record = episode.record();
  std::ostringstream row;
  row.precision(9);
  row << csv_cell(world) << ',' << csv_cell(policy) << ',' << number << ',' << record.steps << ',' << episode.position().north.value << ','
      << episode.position().east.value << ',' << episode.snr().value << ',' << record.reward << ',' << episode.source().north.value << ','
      << episode.source().east.value << ',' << name_of(end) << '\n';
  csv_ += row.str();
}

}  // namespace earshot::evaluate
