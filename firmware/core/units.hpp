#pragma once

#include <compare>

namespace earshot {

/// A number with its unit in the type. Same-unit sums, scaling by a pure number and ratios; every other conversion is spelled out where it
/// happens.
template <class Unit>
struct Quantity {
  double value = 0.0;

  constexpr Quantity() = default;
  explicit constexpr Quantity(double v) : value(v) {}

  friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity{a.value + b.value}; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity{a.value - b.value}; }
  friend constexpr Quantity operator-(Quantity a) { return Quantity{-a.value}; }
  friend constexpr Quantity operator*(double k, Quantity a) { return Quantity{k * a.value}; }
  friend constexpr Quantity operator*(Quantity a, double k) { return Quantity{a.value * k}; }
  friend constexpr Quantity operator/(Quantity a, double k) { return Quantity{a.value / k}; }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
  constexpr Quantity& operator+=(Quantity b) { return value += b.value, *this; }
  constexpr Quantity& operator-=(Quantity b) { return value -= b.value, *this; }
  friend constexpr auto operator<=>(Quantity, Quantity) = default;
};

using Meters = Quantity<struct MetersUnit>;
using MetersPerSecond = Quantity<struct MetersPerSecondUnit>;
using Radians = Quantity<struct RadiansUnit>;  ///< a heading or bearing is clockwise from north
using RadiansPerSecond = Quantity<struct RadiansPerSecondUnit>;
using Decibels = Quantity<struct DecibelsUnit>;  ///< the reference stands in the name or the docstring
using Hertz = Quantity<struct HertzUnit>;

}  // namespace earshot
