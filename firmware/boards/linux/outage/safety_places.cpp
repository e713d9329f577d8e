#include "firmware/boards/linux/outage/safety_places.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "firmware/host/file/checksum_text.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".safety";

/// The first of the folders that systemd names there.
std::optional<fs::path> folder_in(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr || *value == '\0') return std::nullopt;
  const std::string all = value;
  return all.substr(0, all.find(':'));
}

fs::path lexically_whole(const fs::path& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // "out/" is "out"
}

}  // namespace

SafetyFolders SafetyFolders::of_this_process() {
  return {.state = folder_in("STATE_DIRECTORY"), .runtime = folder_in("RUNTIME_DIRECTORY")};
}

std::vector<host::SafetyCopy> safety_places(const fs::path& out, const std::vector<std::string>& asked_for, const SafetyFolders& folders) {
  const fs::path folder = lexically_whole(out);
  const std::string name = folder.filename().string() + "-" + host::crc32_text(host::crc32_of(folder.string())) + kEnding;
  std::vector<host::SafetyCopy> places{{.file = folder / (std::string("journal") + kEnding)}};
  for (const std::string& other : asked_for) places.push_back({.file = lexically_whole(other) / name});
  if (asked_for.empty() && folders.state) places.push_back({.file = lexically_whole(*folders.state) / name});
  if (folders.runtime) places.push_back({.file = lexically_whole(*folders.runtime) / name, .survives_power_cut = false});
  return places;
}

}  // namespace earshot::board
