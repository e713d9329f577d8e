#include "sim/recording/riff.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string_view>

namespace earshot::recording {
namespace {

constexpr std::uint32_t kUnknown = 0xFFFFFFFF;
constexpr std::uint64_t kWrap = std::uint64_t{1} << 32U;
/// A size beyond all disks stands for one that was not known.
constexpr std::uint64_t kBeyondAllDisks = std::uint64_t{1} << 60U;
/// Recorders write a dozen chunks before the samples; a file made to be slow has millions.
constexpr int kMostChunks = 1000;
constexpr int kExtensible = 0xFFFE;

/// The last twelve bytes of the names of W64's chunks; those of "riff" differ.
constexpr std::array<std::uint8_t, 12> kWave64Name{0xF3, 0xAC, 0xD3, 0x11, 0x8C, 0xD1, 0x00, 0xC0, 0x4F, 0x8E, 0xDB, 0x8A};
constexpr std::array<std::uint8_t, 12> kWave64Riff{0x2E, 0x91, 0xCF, 0x11, 0xA5, 0xD6, 0x28, 0xDB, 0x04, 0xC1, 0x00, 0x00};

using Bytes = std::array<std::uint8_t, 40>;

std::uint64_t little_endian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = count; i > 0; --i) value = value << 8U | bytes[at + i - 1];
  return value;
}

class ByteReader {
 public:
  explicit ByteReader(const std::filesystem::path& path) : stream_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

  /// @return whether so many bytes are there
  bool read(std::uint64_t at, std::size_t count) {
    if (at > size_ || count > size_ - at) return false;
    stream_.seekg(static_cast<std::streamoff>(at));
    return static_cast<bool>(stream_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(count)));
  }
  [[nodiscard]] bool is(std::size_t at, std::string_view word) const {
    return std::equal(word.begin(), word.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  [[nodiscard]] bool ends(std::size_t at, const std::array<std::uint8_t, 12>& name) const {
    return std::equal(name.begin(), name.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at) + 4);
  }
  [[nodiscard]] std::string name() const { return {bytes_.begin(), bytes_.begin() + 4}; }
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t count) const { return little_endian(bytes_, at, count); }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::ifstream stream_;
  std::uint64_t size_;
  Bytes bytes_{};
};

/// How chunks are told apart in a kind of file.
struct Dialect {
  bool is_wave64 = false;
  std::uint64_t first_chunk = 12;

  [[nodiscard]] std::size_t header_bytes() const { return is_wave64 ? 24 : 8; }
};

std::optional<Dialect> dialect_of(ByteReader& reader) {
  if (!reader.read(0, 12)) return std::nullopt;
  if ((reader.is(0, "RIFF") || reader.is(0, "RF64") || reader.is(0, "BW64")) && reader.is(8, "WAVE")) return Dialect{};
  if (!reader.read(0, 40) || !reader.is(0, "riff") || !reader.ends(0, kWave64Riff)) return std::nullopt;
  if (!reader.is(24, "wave") || !reader.ends(24, kWave64Name)) return std::nullopt;
  return Dialect{.is_wave64 = true, .first_chunk = 40};
}

bool is_known(std::string_view name) {
  constexpr std::array<std::string_view, 24> kNames{"LIST", "guan", "bext", "iXML", "id3 ", "ID3 ", "cue ", "smpl",
                                                    "inst", "fact", "PEAK", "harp", "JUNK", "junk", "PAD ", "FLLR",
                                                    "DISP", "afsp", "_PMX", "axml", "wamd", "umid", "cart", "chna"};
  return std::ranges::find(kNames, name) != kNames.end();
}

class ChunkWalk {
 public:
  ChunkWalk(ByteReader& reader, Dialect dialect, std::uint64_t at) : reader_(reader), dialect_(dialect), at_(at) {}

  /// The next chunk's header; nothing where none stands.
  std::optional<RiffChunk> next() {
    const std::size_t header = dialect_.header_bytes();
    if (++count_ > kMostChunks || !reader_.read(at_, header)) return std::nullopt;
    RiffChunk chunk{.name = reader_.name(), .begin = at_ + header, .bytes = reader_.number(4, 4)};
    const bool is_word = std::ranges::all_of(chunk.name, [](char c) { return c >= ' ' && c <= '~'; });
    if (!is_word || (dialect_.is_wave64 && !reader_.ends(0, kWave64Name))) return std::nullopt;
    if (dialect_.is_wave64) chunk.bytes = std::max<std::uint64_t>(reader_.number(16, 8), header) - header;
    return chunk;
  }

  /// Passes over so many bytes of content and what fills them up.
  void pass(const RiffChunk& chunk, std::uint64_t bytes) {
    const std::uint64_t step = dialect_.is_wave64 ? 8 : 2;
    at_ = chunk.begin + std::min(bytes, reader_.size());
    at_ += (step - bytes % step) % step;
  }

  [[nodiscard]] bool is_at_end() const { return at_ + dialect_.header_bytes() > reader_.size(); }

 private:
  ByteReader& reader_;
  Dialect dialect_;
  std::uint64_t at_;
  int count_ = 0;
};

/// Whether chunks, and nothing but them, stand from there to the file's end. A rest that is shorter than a chunk's header is none.
bool is_chunks_from(ByteReader& reader, Dialect dialect, std::uint64_t at) {
  if (at >= reader.size()) return at == reader.size();
  ChunkWalk walk(reader, dialect, at);
  while (!walk.is_at_end()) {
    const std::optional<RiffChunk> chunk = walk.next();
    const bool is_whole = chunk && chunk->bytes <= reader.size() - chunk->begin;
    if (!chunk || (!is_whole && !is_known(chunk->name))) return false;
    walk.pass(*chunk, chunk->bytes);
  }
  return true;
}

/// Some writers forget the byte that fills an odd chunk up.
bool is_end_of_samples(ByteReader& reader, Dialect dialect, std::uint64_t at) {
  return is_chunks_from(reader, dialect, at) || (at % 2 == 1 && is_chunks_from(reader, dialect, at + 1)) ||
         (dialect.is_wave64 && is_chunks_from(reader, dialect, (at + 7) / 8 * 8));
}

/// Programs that write into a pipe tell these, up to the size of a header less.
bool is_placeholder(std::uint64_t size, bool is_32_bit) {
  const bool is_all_ones = size >= kUnknown - 0x100U && size <= kUnknown;
  const bool is_half = size >= 0x7FFFF000U - 0x100U && size <= 0x80000000U;
  return size >= kBeyondAllDisks || (is_32_bit && (is_all_ones || is_half));
}

RiffData data_of(ByteReader& reader, Dialect dialect, const RiffChunk& chunk, std::uint64_t declared) {
  RiffData data{.begin = chunk.begin, .declared = declared, .there = reader.size() - chunk.begin};
  if (declared > data.there) {
    if (is_placeholder(declared, !dialect.is_wave64)) data.declared.reset();
    return data;
  }
  for (std::uint64_t bytes = declared; bytes <= data.there; bytes += kWrap) {
    if (!is_end_of_samples(reader, dialect, data.begin + bytes)) continue;
    data.there = bytes;
    return data;
  }
  if (declared == 0) data.declared.reset();
  return data;
}

RiffFormat format_of(ByteReader& reader, const RiffChunk& chunk) {
  RiffFormat format;
  const std::size_t bytes = chunk.bytes >= 26 && reader.read(chunk.begin, 26) ? 26 : 16;
  if (!reader.read(chunk.begin, bytes)) return format;
  format.coding = static_cast<int>(reader.number(0, 2));
  if (format.coding == kExtensible && bytes == 26) format.coding = static_cast<int>(reader.number(24, 2));
  format.channels = static_cast<int>(reader.number(2, 2));
  format.sample_rate_hz = static_cast<int>(std::min<std::uint64_t>(reader.number(4, 4), 0x7FFFFFFF));
  format.bytes_per_frame = static_cast<int>(reader.number(12, 2));
  return format;
}

}  // namespace

std::optional<RiffFile> read_riff(const std::filesystem::path& path) {
  ByteReader reader(path);
  const std::optional<Dialect> dialect = dialect_of(reader);
  if (!dialect) return std::nullopt;
  RiffFile file;
  bool has_data = false;
  std::uint64_t long_size = kUnknown;
  ChunkWalk walk(reader, *dialect, dialect->first_chunk);
  while (std::optional<RiffChunk> chunk = walk.next()) {
    std::uint64_t bytes = chunk->bytes;
    if (chunk->name == "data" && !has_data) {
      const bool has_size_before = !dialect->is_wave64 && long_size != kUnknown && (bytes == kUnknown || bytes == 0);
      file.data = data_of(reader, *dialect, *chunk, has_size_before ? long_size : bytes);
      bytes = file.data.there;
      has_data = true;
    } else {
      if (chunk->name == "data") file.data.elsewhere += std::min(bytes, reader.size() - chunk->begin);
      if (chunk->name == "ds64" && reader.read(chunk->begin, 16)) long_size = reader.number(8, 8);
      if (chunk->name == "fmt ") file.format = format_of(reader, *chunk);
      file.chunks.push_back(*chunk);
    }
    walk.pass(*chunk, bytes);
  }
  return has_data ? std::optional(file) : std::nullopt;
}

std::string content_of(const std::filesystem::path& path, const RiffChunk& chunk, std::uint64_t most) {
  const std::uint64_t size = std::filesystem::file_size(path);
  if (chunk.begin >= size) return {};
  std::string content(static_cast<std::size_t>(std::min({chunk.bytes, most, size - chunk.begin})), '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(chunk.begin));
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return content;
}

}  // namespace earshot::recording
