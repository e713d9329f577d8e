#include "firmware/policy/likelihood/normal_table.hpp"

#include <array>
#include <cstddef>

#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"

namespace earshot::policy {
namespace {

struct NormalTable {
  static constexpr std::size_t kPerUnit = 32;
  static constexpr std::size_t kCount = 8 * kPerUnit + 2;  ///< up to eight standard deviations
  std::array<float, kCount> density{};                     ///< at i / kPerUnit
  std::array<float, kCount> above{};                       ///< probability beyond i / kPerUnit
};

/// e^-x for 0 <= x <= 33: (e^(-x/64))^64, by its series.
consteval double exp_of_minus(double x) {
  const double t = -x / 64.0;
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + t / k * sum;
  for (int k = 0; k < 6; ++k) sum *= sum;
  return sum;
}

consteval double normal(double x) {
  constexpr double kOneOverRootTwoPi = 0.39894228040143267794;
  return kOneOverRootTwoPi * exp_of_minus(0.5 * x * x);
}

consteval NormalTable normal_table() {
  NormalTable table;
  constexpr double kStep = 1.0 / static_cast<double>(NormalTable::kPerUnit);
  double above = 0.5;
  for (std::size_t i = 0; i < NormalTable::kCount; ++i) {
    const double x = static_cast<double>(i) * kStep;
    table.density[i] = static_cast<float>(normal(x));
    table.above[i] = static_cast<float>(above > 0.0 ? above : 0.0);
    above -= kStep / 6.0 * (normal(x) + 4.0 * normal(x + 0.5 * kStep) + normal(x + kStep));  // Simpson
  }
  return table;
}

constexpr NormalTable kNormalTable = normal_table();

/// Linear between the entries of a table; beyond its end as at its end. @param x  >= 0
float interpolate_in(const std::array<float, NormalTable::kCount>& table, float x) {
  constexpr float kEnd = static_cast<float>(NormalTable::kCount - 2);
  const float place = x * static_cast<float>(NormalTable::kPerUnit);
  const float held = lesser(place, kEnd);
  const auto index = static_cast<std::size_t>(static_cast<int>(held));
  return table[index] + (held - static_cast<float>(static_cast<int>(held))) * (table[index + 1] - table[index]);
}

}  // namespace

EARSHOT_WIDE void to_normal_density(std::span<float> numbers) {
  for (float& x : numbers) x = interpolate_in(kNormalTable.density, __builtin_fabsf(x));
}

EARSHOT_WIDE void to_normal_cumulative(std::span<float> numbers) {
  for (float& x : numbers) x = x < 0.0F ? interpolate_in(kNormalTable.above, -x) : 1.0F - interpolate_in(kNormalTable.above, x);
}

}  // namespace earshot::policy
