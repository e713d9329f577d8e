#include "firmware/host/file/distinct_files.hpp"

#include <algorithm>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"

namespace earshot::host {
namespace {

/// Where a file stands or will stand; what it is called may be several names for one.
std::filesystem::path canonical_name(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(followed(path), error);
  return error ? path : canonical;
}

}  // namespace

void DistinctFiles::read(const std::filesystem::path& path) {
  taken_.push_back(canonical_name(path));
}

void DistinctFiles::write(const std::filesystem::path& path) {
  std::filesystem::path target = canonical_name(path);
  if (std::ranges::find(taken_, target) != taken_.end())
    throw BadInput(path.string() + ": cannot be written: the same file is read, or written already");
  taken_.push_back(std::move(target));
}

}  // namespace earshot::host
