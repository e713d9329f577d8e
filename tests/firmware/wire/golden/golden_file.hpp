#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::wire {

/// "0aff"
[[nodiscard]] std::string hex(std::span<const std::uint8_t> bytes);

/// What a test makes, line by line, beside what was recorded of an older build: a file of tests/reference/messages. Wire and journal bytes
/// stay what they are, whatever the code that makes them looks like.
class GoldenFile {
 public:
  explicit GoldenFile(std::string_view name);

  /// "NAME: TEXT"
  void add(std::string_view name, std::string_view text);
  void add(std::string_view name, std::span<const std::uint8_t> bytes) { add(name, hex(bytes)); }

  /// Fails where a line is another one than was recorded, missing or new. What was made is then in the build's folder `golden`: if it is
  /// meant, it takes the recorded file's place, and the changelog says why.
  void expect_as_recorded() const;

 private:
  std::string name_;
  std::vector<std::string> lines_;
};

/// Streams of bytes, of which a file keeps how many there are and their CRC-32.
class Streams {
 public:
  void add(std::string_view stream, std::span<const std::uint8_t> bytes);
  /// "STREAM: 480 records, 33600 bytes, CRC-32 0a0b0c0d, the first FF00"
  void write_to(GoldenFile& file) const;

 private:
  struct Stream {
    std::size_t records = 0;
    std::size_t bytes = 0;
    std::uint32_t crc32 = 0;
    std::string first;
  };
  std::map<std::string, Stream, std::less<>> streams_;
};

}  // namespace earshot::wire
