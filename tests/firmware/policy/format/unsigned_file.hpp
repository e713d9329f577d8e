#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::policy {

/// A policy or ocean tables as the bytes of their file, signed by nobody: whose they are the shell asks, no runtime.
template <class Content>
std::vector<std::uint8_t> unsigned_file(const Content& content) {
  std::vector<std::uint8_t> bytes(std::size_t{1} << 20);
  const std::array<std::uint8_t, kPublicKeySize> nobody{};
  bytes.resize(serialise(content, nobody, bytes).value());
  return bytes;
}

}  // namespace earshot::policy
