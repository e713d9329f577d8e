#include "policy/tables/merge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace earshot::tables {
namespace {

/// A curve and those that it stands for.
struct Cluster {
  OceanCurve curve;
  double heaviest;                                        ///< weight of the member whose name it has
  std::vector<std::size_t> members;                       ///< numbers of the curves given
  std::size_t nearest = 0;                                ///< of the clusters behind it
  double cost = std::numeric_limits<double>::infinity();  ///< of merging with that
};

double cost_of(const OceanCurve& a, const OceanCurve& b) {
  const double d = difference_db(a.snr_db, b.snr_db);
  return a.weight * b.weight / (a.weight + b.weight) * d * d;
}

void find_nearest(std::vector<Cluster>& clusters, std::size_t of) {
  Cluster& cluster = clusters[of];
  cluster.cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = of + 1; i < clusters.size(); ++i) {
    const double cost = cost_of(cluster.curve, clusters[i].curve);
    if (!(cost < cluster.cost)) continue;
    cluster.cost = cost;
    cluster.nearest = i;
  }
}

void put_into(Cluster& to, const Cluster& from) {
  const double weight = to.curve.weight + from.curve.weight;
  for (std::size_t i = 0; i < to.curve.snr_db.size(); ++i)
    to.curve.snr_db[i] = (to.curve.weight * to.curve.snr_db[i] + from.curve.weight * from.curve.snr_db[i]) / weight;
  if (from.heaviest > to.heaviest) {
    to.curve.name = from.curve.name;
    to.curve.detail = from.curve.detail;
    to.curve.sea_depth = from.curve.sea_depth;
    to.curve.source_depth = from.curve.source_depth;
    to.heaviest = from.heaviest;
  }
  to.curve.weight = weight;
  to.members.insert(to.members.end(), from.members.begin(), from.members.end());
}

/// Merges the pair that costs least, and finds the nearest of those anew that had one of the two.
void merge_cheapest(std::vector<Cluster>& clusters) {
  const auto cheapest = std::ranges::min_element(clusters, {}, &Cluster::cost);
  const auto kept = static_cast<std::size_t>(cheapest - clusters.begin());
  const std::size_t gone = cheapest->nearest;
  put_into(clusters[kept], clusters[gone]);
  clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(gone));
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Cluster& cluster = clusters[i];
    const bool had_one = i == kept || cluster.nearest == kept || cluster.nearest == gone;
    if (cluster.nearest > gone) --cluster.nearest;
    if (had_one) {
      find_nearest(clusters, i);
    } else if (i < kept) {
      if (const double cost = cost_of(cluster.curve, clusters[kept].curve); cost < cluster.cost) {
        cluster.cost = cost;
        cluster.nearest = kept;
      }
    }
  }
}

}  // namespace

double difference_db(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  std::size_t audible = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::max(a[i], b[i]) > kAudible_db)) continue;
    const double difference = std::max(a[i], kAudible_db) - std::max(b[i], kAudible_db);
    sum += difference * difference;
    ++audible;
  }
  return audible > 0 ? std::sqrt(sum / static_cast<double>(audible)) : 0.0;
}

Merged merge(const std::vector<OceanCurve>& curves, std::size_t at_most) {
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < curves.size(); ++i) clusters.push_back({.curve = curves[i], .heaviest = curves[i].weight, .members = {i}});
  if (clusters.size() > at_most)
    for (std::size_t i = 0; i < clusters.size(); ++i) find_nearest(clusters, i);
  while (clusters.size() > at_most) merge_cheapest(clusters);
  Merged merged;
  for (Cluster& cluster : clusters) {
    for (const std::size_t member : cluster.members)
      merged.most_difference_db = std::max(merged.most_difference_db, difference_db(curves[member].snr_db, cluster.curve.snr_db));
    merged.curves.push_back(std::move(cluster.curve));
  }
  return merged;
}

}  // namespace earshot::tables
