#include "firmware/host/journal/bus_log.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

std::optional<std::size_t> largest_event_of_bus_log(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestMessage_bytes = std::uint64_t{64} << 20U;  // a picture; it is held in memory
  InputFile file(path, kAnySize);
  std::array<std::uint8_t, kRecordHeaderSize> bytes{};
  const std::span header(bytes);
  std::uint64_t largest = 0;
  std::uint64_t next_number = 0;
  for (std::uint64_t at = 0; at < file.size();) {
    if (file.read(header) < header.size()) break;
    const std::uint64_t number = load_big_endian(header.subspan(4, 8));
    const std::uint64_t channel_size = load_big_endian(header.subspan(20, 4));
    const std::uint64_t data_size = load_big_endian(header.subspan(24, 4));
    if (load_big_endian(header.first(4)) != kRecordSync || (number != next_number && number != 0) || channel_size < 1 ||
        channel_size > wire::kMaxChannelLength || data_size > kLargestMessage_bytes)
      return std::nullopt;
    next_number = number + 1;
    const std::uint64_t size = kRecordHeaderSize + channel_size + data_size;
    largest = std::max(largest, size);
    at += size;
    file.go_to(at);
  }
  return largest > 0 ? std::optional(static_cast<std::size_t>(largest)) : std::nullopt;
}

}  // namespace earshot::host
