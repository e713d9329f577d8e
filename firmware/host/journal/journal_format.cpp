#include "firmware/host/journal/journal_format.hpp"

#include <algorithm>

#include "firmware/core/crc32.hpp"

namespace earshot::host {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::array<std::uint8_t, kRecordHeaderSize> record_header(std::uint32_t number, Time time, std::string_view channel,
                                                          std::span<const std::uint8_t> data) {
  std::array<std::uint8_t, kRecordHeaderSize> header{};
  HeaderWriter rest{header, kCheckedFrom};
  rest.field(4, number);
  rest.field(8, static_cast<std::uint64_t>(time.us));
  rest.field(4, channel.size());
  rest.field(4, data.size());
  const std::uint32_t checksum = crc32(data, crc32(bytes_of(channel), crc32(std::span(header).subspan(kCheckedFrom))));
  HeaderWriter start{header};
  start.field(4, kRecordSync);
  start.field(4, checksum);
  return header;
}

std::uint32_t checksum_of_record(std::uint32_t number, Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  const auto header = record_header(number, time, channel, data);
  return static_cast<std::uint32_t>(load_big_endian(std::span(header).subspan(4, 4)));
}

LoneRecord::LoneRecord(std::uint32_t number, Time time, std::string_view channel, std::span<const std::uint8_t> data)
    : size_(kRecordHeaderSize + channel.size() + data.size()) {
  auto end = std::ranges::copy(record_header(number, time, channel, data), bytes_.begin()).out;
  end = std::ranges::copy(bytes_of(channel), end).out;
  std::ranges::copy(data, end);
}

}  // namespace earshot::host
