#include "firmware/host/file/shipped.hpp"

#include <system_error>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {

std::filesystem::path shipped(const std::filesystem::path& relative) {
  std::error_code error;
  const std::filesystem::path bin = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* root : {"../../..", "../share/earshot"}) {
    std::filesystem::path path = (bin / root / relative).lexically_normal();
    if (std::filesystem::exists(path, error)) return path;
  }
  throw BadInput(relative.string() + ": is neither in the source tree that " + bin.string() + " was built in, nor installed beside it");
}

}  // namespace earshot::host
