#include "firmware/boards/linux/outage/safety_places.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
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

/// Of a small file; empty: there is none, or it cannot be read.
std::string text_of(const fs::path& path) {
  std::string text;
  std::ifstream(path) >> text;
  return text;
}

}  // namespace

host::RecordOwner record_owner(const fs::path& out, const ComputerFiles& files) {
  std::error_code error;
  const std::string machine_id = text_of(files.machine_id);
  const bool is_of_this_start = fs::exists(files.transient_machine_id, error) || machine_id == "uninitialized";  // as machine-id(5) says
  const std::string identity = (is_of_this_start ? std::string() : machine_id) + text_of(files.serial_number);
  return {.computer = identity.empty() ? 0 : host::crc32_of(identity), .folder = host::crc32_of(lexically_whole(out).string())};
}

SafetyFolders SafetyFolders::of_this_process() {
  return {.state = folder_in("STATE_DIRECTORY"), .runtime = folder_in("RUNTIME_DIRECTORY")};
}

std::vector<host::SafetyCopy> safety_places(const fs::path& out, const std::vector<std::string>& asked_for, const SafetyFolders& folders,
                                            DetectsMemory is_in_memory) {
  const fs::path folder = lexically_whole(out);
  const std::string name = folder.filename().string() + "-" + host::crc32_text(host::crc32_of(folder.string())) + kEnding;
  std::vector<host::SafetyCopy> places{{.file = folder / (std::string("journal") + kEnding)}};
  for (const std::string& other : asked_for) places.push_back({.file = lexically_whole(other) / name});
  if (asked_for.empty() && folders.state) places.push_back({.file = lexically_whole(*folders.state) / name});
  if (places.size() == 1) places.push_back({.file = folder / (std::string("journal.copy") + kEnding)});
  for (host::SafetyCopy& copy : places) copy.survives_power_cut = !is_in_memory(copy.file.parent_path());
  if (folders.runtime) places.push_back({.file = lexically_whole(*folders.runtime) / name, .survives_power_cut = false});
  return places;
}

std::vector<std::string> warnings_about(const std::vector<host::SafetyCopy>& places, const SafetyFolders& folders) {
  std::vector<std::string> warnings;
  for (const host::SafetyCopy& copy : places) {
    const bool is_to_be_in_memory = folders.runtime && copy.file.parent_path() == lexically_whole(*folders.runtime);
    if (!copy.survives_power_cut && !is_to_be_in_memory)
      warnings.push_back("safety record " + copy.file.string() + ": it is in memory (tmpfs), and gone with a power cut");
  }
  if (std::ranges::none_of(places, &host::SafetyCopy::survives_power_cut))
    warnings.emplace_back(
        "no copy of the safety record is on a disk: every order is OBEYED_NOT_DURABLE, and a restart after a power cut knows of no "
        "mission; "
        "--safety-copy names a folder on a disk");
  return warnings;
}

}  // namespace earshot::board
