#include "policy/tables/expected.hpp"

#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::tables {
namespace {

double weight_of(const std::vector<OceanCurve>& curves) {
  double sum = 0.0;
  for (const OceanCurve& curve : curves) sum += curve.weight;
  return sum;
}

}  // namespace

Merged merge_beside(const std::vector<OceanCurve>& expected, const std::vector<OceanCurve>& others, std::size_t at_most) {
  const std::size_t needed = expected.size() + (others.empty() ? 0 : 1);
  if (needed > at_most)
    throw host::BadInput("--expected: " + std::to_string(expected.size()) +
                         " curves, which are not merged and leave no room for others in " + std::to_string(at_most) + " tables");
  Merged merged = merge(others, at_most - expected.size());
  const double scale = others.empty() || expected.empty() ? 1.0 : weight_of(others) / weight_of(expected);
  std::vector<OceanCurve> curves = expected;
  for (OceanCurve& curve : curves) curve.weight *= scale;
  for (OceanCurve& curve : merged.curves) curves.push_back(std::move(curve));
  merged.curves = std::move(curves);
  return merged;
}

}  // namespace earshot::tables
