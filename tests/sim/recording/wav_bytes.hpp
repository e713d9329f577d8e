#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace earshot::tests {

inline std::string little_endian(std::uint64_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8U * i) & 0xFFU);
  return text;
}

inline std::string chunk(const std::string& name, const std::string& content) {
  return name + little_endian(content.size(), 4) + content + std::string(content.size() % 2, '\0');
}

/// A RIFF INFO chunk of pairs of a name and a text.
inline std::string info_chunk(const std::vector<std::pair<std::string, std::string>>& texts) {
  std::string content = "INFO";
  for (const auto& [name, text] : texts) content += chunk(name, text + '\0');
  return chunk("LIST", content);
}

/// A WAV file by hand, after the print of 1991: what the tests hold the reader against is not written by its own library.
struct WavBytes {
  std::uint32_t sample_rate = 2000;
  std::uint16_t channels = 1;
  std::uint16_t bits = 16;
  std::uint16_t format = 1;         ///< 1: PCM, 3: IEEE float, 7: mu-law
  std::string before_format{};      ///< chunks
  std::string samples{};            ///< bytes
  std::uint32_t declares_more = 0;  ///< bytes that the header tells of and that are not there

  [[nodiscard]] std::string bytes() const {
    const auto frame = static_cast<std::uint16_t>(channels * bits / 8);
    const std::string fmt = little_endian(format, 2) + little_endian(channels, 2) + little_endian(sample_rate, 4) +
                            little_endian(std::uint64_t{sample_rate} * frame, 4) + little_endian(frame, 2) + little_endian(bits, 2);
    const std::string body =
        "WAVE" + before_format + chunk("fmt ", fmt) + "data" + little_endian(samples.size() + declares_more, 4) + samples;
    return "RIFF" + little_endian(body.size() + declares_more, 4) + body;
  }
};

inline std::string int16_samples(std::span<const int> values) {
  std::string text;
  for (const int value : values) text += little_endian(static_cast<std::uint16_t>(value), 2);
  return text;
}

inline std::string float_samples(std::span<const float> values) {
  std::string text;
  for (const float value : values) text += little_endian(std::bit_cast<std::uint32_t>(value), 4);
  return text;
}

inline void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace earshot::tests
