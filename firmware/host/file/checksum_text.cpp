#include "firmware/host/file/checksum_text.hpp"

#include <array>
#include <cstdio>

#include "firmware/core/crc32.hpp"

namespace earshot::host {

std::uint32_t crc32_of(std::string_view text, std::uint32_t previous) {
  return crc32({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, previous);  // NOLINT: characters are bytes
}

std::string crc32_text(std::uint32_t crc32) {
  std::array<char, 9> text{};
  (void)std::snprintf(text.data(), text.size(), "%08x", static_cast<unsigned>(crc32));
  return text.data();
}

}  // namespace earshot::host
