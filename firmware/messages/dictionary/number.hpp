#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

// What a field of a message is made of when it leaves a program: a plain number.

enum class NumberType : std::uint8_t { kInt8, kByte, kBoolean, kInt32, kInt64, kFloat, kDouble };

template <class Unit>
constexpr double plain(Quantity<Unit> quantity) {
  return quantity.value;
}
constexpr std::int64_t plain(Time time) {
  return time.us;
}
constexpr std::int64_t plain(Duration duration) {
  return duration.us;
}
constexpr bool plain(bool yes) {
  return yes;
}
constexpr float plain(float number) {
  return number;
}
constexpr double plain(double number) {
  return number;
}
/// Numbers without a sign leave as they lie in memory: others know only those with one.
template <std::integral Number>
constexpr auto plain(Number number) {
  return static_cast<std::make_signed_t<Number>>(number);
}
template <class Enum>
requires std::is_enum_v<Enum>
constexpr auto plain(Enum value) {
  return static_cast<std::make_signed_t<std::underlying_type_t<Enum>>>(value);
}

template <class Value>
using Plain = decltype(plain(Value{}));

/// The value that a plain number stands for.
template <class Value>
constexpr Value made_of(Plain<Value> number) {
  if constexpr (std::is_same_v<Value, Time> || std::is_same_v<Value, Duration>) {
    return Value{.us = number};
  } else if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
    return static_cast<Value>(number);
  } else {
    return Value{number};
  }
}

template <class Number>
consteval NumberType type_of() {
  if constexpr (std::is_same_v<Number, bool>) return NumberType::kBoolean;
  if constexpr (std::is_same_v<Number, float>) return NumberType::kFloat;
  if constexpr (std::is_same_v<Number, double>) return NumberType::kDouble;
  if constexpr (std::is_same_v<Number, std::uint8_t>) return NumberType::kByte;
  // By their sizes: of two integers of one size, as int and long are on some machines, only one is std::int32_t.
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 1) return NumberType::kInt8;
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 4) return NumberType::kInt32;
  if constexpr (std::is_integral_v<Number> && sizeof(Number) == 8) return NumberType::kInt64;
}

}  // namespace earshot::messages
