#include "sim/recording/riff.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string_view>

namespace earshot::recording {
namespace {

constexpr std::uint32_t kUnknown = 0xFFFFFFFF;
constexpr std::size_t kChunkHeader_bytes = 8;
/// Recorders write a dozen chunks before the samples; a file made to be slow has millions.
constexpr int kMostChunks = 1000;

using Bytes = std::array<std::uint8_t, 16>;

std::uint64_t little_endian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value << 8U | bytes[at + i - 1];
  return value;
}

class ChunkReader {
 public:
  explicit ChunkReader(const std::filesystem::path& path) : stream_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

  /// @return whether so many bytes are there
  bool read(std::uint64_t at, std::size_t count) {
    if (at > size_ || count > size_ - at) return false;
    stream_.seekg(static_cast<std::streamoff>(at));
    return static_cast<bool>(stream_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(count)));
  }
  [[nodiscard]] bool is(std::size_t at, std::string_view word) const {
    return std::equal(word.begin(), word.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t count) const { return little_endian(bytes_, at, count); }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::ifstream stream_;
  std::uint64_t size_;
  Bytes bytes_{};
};

}  // namespace

std::optional<RiffData> riff_data(const std::filesystem::path& path) {
  ChunkReader reader(path);
  if (!reader.read(0, 12) || !(reader.is(0, "RIFF") || reader.is(0, "RF64")) || !reader.is(8, "WAVE")) return std::nullopt;
  std::uint64_t long_size = kUnknown;
  std::uint64_t at = 12;
  for (int chunk = 0; chunk < kMostChunks && reader.read(at, kChunkHeader_bytes); ++chunk) {
    const std::uint64_t size = reader.number(4, 4);
    const std::uint64_t content = at + kChunkHeader_bytes;
    if (reader.is(0, "data")) {
      const std::uint64_t told = size == kUnknown ? long_size : size;
      if (told == kUnknown || told == 0) return std::nullopt;
      return RiffData{.told = told, .there = std::min(told, reader.size() - content)};
    }
    if (reader.is(0, "ds64") && reader.read(content, 16)) long_size = reader.number(8, 8);
    at = content + size + (size & 1U);
  }
  return std::nullopt;
}

}  // namespace earshot::recording
