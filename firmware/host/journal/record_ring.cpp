#include "firmware/host/journal/record_ring.hpp"

#include <algorithm>

namespace earshot::host {

void RecordRing::copy_in(std::uint64_t& position, std::span<const std::uint8_t> bytes) {
  const auto at = static_cast<std::size_t>(position % bytes_.size());
  const std::size_t before_end = std::min(bytes.size(), bytes_.size() - at);
  std::ranges::copy(bytes.first(before_end), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  std::ranges::copy(bytes.subspan(before_end), bytes_.begin());
  position += bytes.size();
}

std::span<const std::uint8_t> RecordRing::piece(std::uint64_t begin, std::uint64_t end) const {
  const auto at = static_cast<std::size_t>(begin % bytes_.size());
  return std::span(bytes_).subspan(at, static_cast<std::size_t>(std::min<std::uint64_t>(end - begin, bytes_.size() - at)));
}

}  // namespace earshot::host
