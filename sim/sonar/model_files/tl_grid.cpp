#include "sim/sonar/model_files/tl_grid.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace earshot::sonar::model_files {
namespace {

static_assert(std::endian::native == std::endian::little,
              "tl.grid has the byte order of the machine, which readers take for little endian");

template <class Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof(number)};
}

/// Its length in bytes stands before a record and behind it.
std::string record(std::string_view content) {
  const std::string length = bytes_of(static_cast<std::int32_t>(content.size()));
  return length + std::string(content) + length;
}

}  // namespace

void write_tl_grid(const std::filesystem::path& path, const SonarField& field) {
  host::OutputFile file(path);
  file.write(record(bytes_of(static_cast<std::int32_t>(field.depth_m.size()))));
  const std::size_t row = field.depth_m.size() * sizeof(float);
  for (std::size_t range = 0; range < field.range_m.size(); ++range) {
    const auto* losses = reinterpret_cast<const char*>(field.transmission_loss_db.data() + range * field.depth_m.size());
    file.write(record({losses, row}));
  }
  file.commit();
}

}  // namespace earshot::sonar::model_files
