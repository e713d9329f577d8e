#include "hil/bench/lcm/keyed_mission.hpp"

#include <fstream>
#include <string>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "hil/bench/disarmed.hpp"

namespace earshot::hil {
namespace {

constexpr const char* kKeyFile = "with_key.key";
constexpr const char* kMission = "with_key.toml";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file;
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.open(path);
  file << text;
  file.close();
}

}  // namespace

host::CommandKey bench_key() {
  host::KeyBytes bytes;
  bytes.fill(0xBE);
  return host::CommandKey(bytes);
}

std::filesystem::path keyed_mission(const std::filesystem::path& mission, const std::filesystem::path& folder) {
  std::string digits;
  for (std::size_t i = 0; i < host::KeyBytes{}.size(); ++i) digits += "be";
  using std::filesystem::perms;
  write(folder / kKeyFile, digits + "\n");
  std::filesystem::permissions(folder / kKeyFile, perms::owner_read | perms::owner_write);
  const std::string text = disarmed(host::read_text(mission, host::kTomlFile), {}, mission.parent_path());
  write(folder / kMission, text + "\n[authority]\nkey_file = \"" + kKeyFile + "\"\n");
  return folder / kMission;
}

}  // namespace earshot::hil
