// Field libraries (NetCDF): a small good one, spoilt. The input is a row of changes to its bytes (see spoil()): in its header to names,
// types, dimensions and attributes, behind it to values. A first byte that is odd cuts the file off at the place that follows (2 bytes).

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "sim/field_library/reader.hpp"
#include "sim/field_library/store.hpp"
#include "sim/netcdf/file_error.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::fuzz {
namespace {

/// Two positions, two bearings, ranges 100 m and 200 m, depths 10 m and 50 m.
std::vector<std::uint8_t> good_library(const std::filesystem::path& path) {
  const field_library::LibraryPlan plan{.name = "two",
                                        .environment = {},
                                        .positions = {{Meters{0.0}, Meters{0.0}}, {Meters{0.0}, Meters{1000.0}}},
                                        .centre = field_library::Centre::kSource,
                                        .fan = {.bearings = 2,
                                                .radial = {.source_depth = Meters{30.0},
                                                           .depth_m = {10.0, 50.0},
                                                           .range_step = Meters{100.0},
                                                           .ranges = 2,
                                                           .band = {Hertz{20.0}, Hertz{20.0}}}},
                                        .file_crc32 = 1};
  field_library::LibraryStore store(path, plan);
  for (const std::size_t position : {0U, 1U}) store.write(position, std::vector<float>(8, 60.0F + static_cast<float>(position)));
  store.commit();
  return host::read_bytes(path, host::kAnySize);
}

void require_sound(const field_library::FieldLibrary& library) {
  require(!library.fans().empty() && !library.frequency_hz().empty(), "a library was read that holds nothing");
  for (const sonar::Fan& fan : library.fans()) {
    require(std::isfinite(fan.centre.north.value) && std::isfinite(fan.centre.east.value), "a fan is nowhere");
    require(fan.range_step.value > 0.0 && fan.transmission_loss_db.size() == fan.bearings * fan.ranges * fan.depth_m.size(),
            "a fan has values that lie nowhere");
    for (const float loss_db : fan.transmission_loss_db) require(std::isnan(loss_db) || std::isfinite(loss_db), "a loss is infinite");
  }
}

}  // namespace

void judge(std::span<const std::uint8_t> bytes) {
  static const support::TemporaryFolder folder;
  static const std::vector<std::uint8_t> good = good_library(folder / "good.nc");
  std::vector<std::uint8_t> spoilt = good;
  Input input(bytes);
  if (input.byte() % 2 == 1) spoilt.resize(std::min<std::size_t>(input.word(), spoilt.size()));
  while (!input.is_used_up()) spoil(spoilt, input);
  const std::filesystem::path path = folder / "spoilt.nc";
  std::ofstream(path).write(reinterpret_cast<const char*>(spoilt.data()), static_cast<std::streamsize>(spoilt.size()));
  try {
    require_sound(field_library::FieldLibrary(path));
  } catch (const netcdf::FileError& refusal) {
    require_names_file(refusal.what(), path.string());
  }
}

}  // namespace earshot::fuzz
