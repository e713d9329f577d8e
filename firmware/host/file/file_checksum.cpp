#include "firmware/host/file/file_checksum.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::host {

std::uint32_t crc32_of_file(const std::filesystem::path& path, std::uint32_t previous) {
  InputFile file(path, kAnySize);
  std::vector<std::uint8_t> piece(std::size_t{1} << 20U);
  for (std::size_t size = piece.size(); size == piece.size();) {
    size = file.read(piece);
    previous = crc32(std::span(piece).first(size), previous);
  }
  return previous;
}

}  // namespace earshot::host
