#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "firmware/core/crc32.hpp"

namespace earshot::runtime {

/// Byte by byte, with what lies between the members: nobody writes there.
template <class T>
bool are_same_bytes(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}
template <class T>
void copy_bytes(const T& from, T& to) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(&to, &from, sizeof(T));
}

template <class T>
std::uint32_t checksum_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return crc32({reinterpret_cast<const std::uint8_t*>(&value), sizeof(T)});
}

}  // namespace earshot::runtime
