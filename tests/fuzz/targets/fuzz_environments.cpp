// Environment files: the input is the text of one.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::fuzz {

void judge(std::span<const std::uint8_t> bytes) {
  static const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "ocean.toml";
  std::ofstream(path).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  try {
    const ocean::Environment environment = ocean::load_environment(path);
    require(environment.source.frequency.value > 0.0 && std::isfinite(environment.source.frequency.value), "a source without a frequency");
    require(std::isfinite(environment.source.level.value) && std::isfinite(environment.noise_level.value), "a level that is no number");
    require(environment.source.depth.value > 0.0 && std::isfinite(environment.source.depth.value), "a source out of the water");
    require(environment.seabed.depth.value > 0.0 && !environment.seabed.layers.empty(), "an ocean without a sea floor");
  } catch (const host::BadInput& refusal) {
    // A file that it names is refused by that one's name.
    require(std::string(refusal.what()).find(": ") != std::string::npos, "a refusal does not begin with a file");
  }
}

}  // namespace earshot::fuzz
