#include "firmware/host/file/shipped.hpp"

#include <cstdlib>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"

namespace earshot::host {

namespace fs = std::filesystem;

fs::path own_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

fs::path shipped(const fs::path& relative, const fs::path& bin, const std::string& data_variable) {
  std::error_code error;
  if (!data_variable.empty()) {
    fs::path path = (data_variable / relative).lexically_normal();
    if (fs::exists(path, error)) return path;
    throw BadInput(relative.string() + ": is not in " + data_variable + ", the folder that " + kDataVariable + " names");
  }
  for (const char* root : {"../share/earshot", "../../.."}) {
    fs::path path = (bin / root / relative).lexically_normal();
    if (fs::exists(path, error)) return path;
  }
  throw BadInput(relative.string() + ": is neither installed beside " + bin.string() +
                 " (in ../share/earshot), nor in the source tree that it was built in; " + kDataVariable + " may name its folder");
}

fs::path shipped(const fs::path& relative) {
  const char* const variable = std::getenv(kDataVariable);
  return shipped(relative, own_folder(), variable == nullptr ? "" : variable);
}

std::string shipped_instead(const fs::path& missing) {
  if (missing.is_absolute()) return {};
  try {
    const fs::path ships = shipped(missing);
    return fs::is_regular_file(ships) ? "; the one that ships is " + printable(ships.string()) : "";
  } catch (const BadInput&) {
    return {};
  } catch (const fs::filesystem_error&) {
    return {};
  }
}

fs::path shipped_library(const std::string& name) {
  for (const char* folder : {".", "../lib/earshot"}) {
    std::error_code error;
    fs::path path = (own_folder() / folder / name).lexically_normal();
    if (fs::exists(path, error)) return path;
  }
  return {};
}

}  // namespace earshot::host
