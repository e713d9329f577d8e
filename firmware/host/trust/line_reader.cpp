#include "firmware/host/trust/line_reader.hpp"

#include <charconv>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::host {
namespace {

constexpr const char* kCounter = "counter";
constexpr const char* kMission = "mission_sha256";
constexpr const char* kPolicy = "policy_sha256";

}  // namespace

void LineReader::refuse(const std::string& allowed) const {
  throw BadInput(file_.string() + ":" + std::to_string(line_) + ": must be " + allowed);
}

std::string_view LineReader::value(std::string_view name, const std::string& allowed) {
  ++line_;
  const std::size_t end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  const bool is_this = end != std::string_view::npos && line.starts_with(name) && line.substr(name.size()).starts_with(' ');
  if (!is_this) refuse(allowed);
  rest_.remove_prefix(end + 1);
  return line.substr(name.size() + 1);
}

void LineReader::title(std::string_view title) {
  ++line_;
  const bool is_this = rest_.starts_with(title) && rest_.substr(title.size()).starts_with('\n');
  if (!is_this) refuse("\"" + std::string(title) + "\"");
  rest_.remove_prefix(title.size() + 1);
}

std::uint64_t LineReader::number(std::string_view name) {
  const std::string allowed = "\"" + std::string(name) + "\" and a whole number";
  const std::string_view text = value(name, allowed);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || std::to_string(number) != text) refuse(allowed);
  return number;
}

void LineReader::bytes(std::string_view name, std::span<std::uint8_t> bytes) {
  const std::string allowed = "\"" + std::string(name) + "\" and " + std::to_string(2 * bytes.size()) + " hexadecimal digits";
  if (!from_hex(value(name, allowed), bytes)) refuse(allowed);
}

authority::MissionManifest LineReader::manifest() {
  authority::MissionManifest manifest;
  manifest.counter = number(kCounter);
  bytes(kMission, manifest.mission);
  bytes(kPolicy, manifest.policy);
  return manifest;
}

void LineReader::end() {
  ++line_;
  if (!rest_.empty()) refuse("the end of the file");
}

std::string lines_of(const authority::MissionManifest& manifest) {
  return std::string(kCounter) + " " + std::to_string(manifest.counter) + "\n" + kMission + " " + to_hex(manifest.mission) + "\n" +
         kPolicy + " " + to_hex(manifest.policy) + "\n";
}

}  // namespace earshot::host
