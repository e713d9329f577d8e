#include "sim/field_library/reader.hpp"

#include <algorithm>

#include "sim/field_library/library_file.hpp"

namespace earshot::field_library {

FieldLibrary::FieldLibrary(const std::filesystem::path& path) {
  const LibraryFile file(path);
  file.require_room(file.positions());
  for (std::size_t position = 0; position < file.positions(); ++position) {
    if (file.has_water(position)) fans_.push_back(file.fan(position));
  }
  if (fans_.empty()) throw file.error("position_state", "no position has a field");
  if (!std::ranges::any_of(fans_, sonar::has_sound)) throw file.error("transmission_loss", "all its values are missing");
  centre_ = file.centre();
  centre_depth_ = file.centre_depth();
  frequency_hz_ = file.frequency_hz();
}

void require_library(const std::filesystem::path& path) {
  const LibraryFile file(path);
  file.require_room(file.positions());
}

sonar::Fan read_library_fan(const std::filesystem::path& path, std::size_t position) {
  return LibraryFile(path).fan(position);
}

}  // namespace earshot::field_library
