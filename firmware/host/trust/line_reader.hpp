#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/authority/mission_manifest.hpp"

namespace earshot::host {

/// Reads a text of lines "NAME VALUE" that must stand in one order and leave nothing over. What decides whether a mission is flown has no
/// syntax in which two readers could see two things.
/// Each throws BadInput, "FILE:LINE: must be ...".
class LineReader {
 public:
  LineReader(std::string_view text, std::filesystem::path file) : rest_(text), file_(std::move(file)) {}

  void title(std::string_view title);
  [[nodiscard]] std::uint64_t number(std::string_view name);
  void bytes(std::string_view name, std::span<std::uint8_t> bytes);  ///< two hexadecimal digits each
  [[nodiscard]] authority::MissionManifest manifest();
  void end();

 private:
  [[nodiscard]] std::string_view value(std::string_view name, const std::string& allowed);
  [[noreturn]] void refuse(const std::string& allowed) const;

  std::string_view rest_;
  std::filesystem::path file_;
  std::size_t line_ = 0;
};

/// As LineReader::manifest() reads them.
[[nodiscard]] std::string lines_of(const authority::MissionManifest& manifest);

}  // namespace earshot::host
