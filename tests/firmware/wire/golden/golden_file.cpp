#include "tests/firmware/wire/golden/golden_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "firmware/core/crc32.hpp"

namespace earshot::wire {
namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('#')) lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

GoldenFile::GoldenFile(std::string_view name) : name_(name) {}

void GoldenFile::add(std::string_view name, std::string_view text) {
  lines_.push_back(std::string(name) + ": " + std::string(text));
}

void GoldenFile::expect_as_recorded() const {
  const std::filesystem::path recorded = std::filesystem::path(EARSHOT_SOURCE_DIR) / "tests/reference/messages" / name_;
  const std::vector<std::string> expected = lines_of(recorded);
  if (lines_ == expected) return;
  const std::filesystem::path made = std::filesystem::path(EARSHOT_BIN_DIR).parent_path() / "golden" / name_;
  std::filesystem::create_directories(made.parent_path());
  std::ofstream file(made);
  file << "# Generated: what tests/firmware/wire/golden makes. Do not edit.\n";
  for (const std::string& line : lines_) file << line << '\n';
  const auto [here, there] = std::ranges::mismatch(lines_, expected);
  FAIL() << recorded << " says\n  " << (there == expected.end() ? "nothing more" : *there) << "\nwhere this build makes\n  "
         << (here == lines_.end() ? "nothing more" : *here) << "\nAll that it makes is in " << made;
}

void Streams::add(std::string_view stream, std::span<const std::uint8_t> bytes) {
  Stream& of = streams_[std::string(stream)];
  if (of.records == 0) of.first = hex(bytes);
  ++of.records;
  of.bytes += bytes.size();
  of.crc32 = crc32(bytes, of.crc32);
}

void Streams::write_to(GoldenFile& file) const {
  for (const auto& [name, stream] : streams_) {
    std::array<char, 80> text{};
    (void)std::snprintf(text.data(), text.size(), "%zu records, %zu bytes, CRC-32 %08x, the first ", stream.records, stream.bytes,
                        stream.crc32);
    file.add(name, text.data() + stream.first);
  }
}

}  // namespace earshot::wire
