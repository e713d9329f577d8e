#include "policy/tables/expected.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::tables {
namespace {

double weight_of(const std::vector<OceanCurve>& curves) {
  double sum = 0.0;
  for (const OceanCurve& curve : curves) sum += curve.weight;
  return sum;
}

/// Puts curves before others, made to weigh so many times as much as these together.
void put_before(std::vector<OceanCurve>& others, std::vector<OceanCurve> curves, double times) {
  const double scale = others.empty() || curves.empty() ? 1.0 : times * weight_of(others) / weight_of(curves);
  for (OceanCurve& curve : curves) curve.weight *= scale;
  curves.insert(curves.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  others = std::move(curves);
}

}  // namespace

Merged merge_beside(const Unmerged& unmerged, const std::vector<OceanCurve>& others, std::size_t at_most) {
  const std::size_t kept = unmerged.expected.size() + unmerged.variants.size();
  if (kept + (others.empty() ? 0 : 1) > at_most)
    throw host::BadInput("--expected, --variants: " + std::to_string(kept) +
                         " curves, which are not merged and leave no room for others in " + std::to_string(at_most) + " tables");
  Merged merged = merge(others, at_most - kept);
  const double per_other = merged.curves.empty() ? 1.0 : 1.0 / static_cast<double>(merged.curves.size());
  put_before(merged.curves, unmerged.variants, static_cast<double>(unmerged.variants.size()) * per_other);
  put_before(merged.curves, unmerged.expected, 1.0);
  return merged;
}

}  // namespace earshot::tables
