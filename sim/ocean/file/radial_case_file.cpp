#include "sim/ocean/file/radial_case_file.hpp"

#include <string>

#include "firmware/host/file/file_type.hpp"
#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"
#include "sim/ocean/file/ram/ram_file.hpp"

namespace earshot::ocean {

bool is_radial_case_name(const std::filesystem::path& path) {
  const std::string suffix = host::suffix_of(path);
  return suffix == ".env" || suffix == ".in";
}

RadialCase load_radial_case(const std::filesystem::path& path) {
  return host::suffix_of(path) == ".in" ? ram::load_ram(path) : acoustics_toolbox::load_env(path);
}

}  // namespace earshot::ocean
