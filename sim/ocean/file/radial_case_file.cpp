#include "sim/ocean/file/radial_case_file.hpp"

#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"

namespace earshot::ocean {

bool is_radial_case_name(const std::filesystem::path& path) {
  return path.extension() == ".env";
}

RadialCase load_radial_case(const std::filesystem::path& path) {
  return acoustics_toolbox::load_env(path);
}

}  // namespace earshot::ocean
