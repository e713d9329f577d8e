#include "sim/sonar/field_library.hpp"

#include <string>

#include "sim/netcdf/reader.hpp"
#include "sim/sonar/library_store.hpp"

namespace earshot::sonar {
namespace {

constexpr double kMostBytes = 2147483648.0;

/// The axes of a library, read once.
class LibraryFile {
 public:
  explicit LibraryFile(const std::filesystem::path& path) : file_(path) {
    if (file_.dimensions_of("transmission_loss") != std::vector<std::string>{"position", "bearing", "range", "depth"})
      throw file_.error("transmission_loss", "must have the dimensions (position, bearing, range, depth)");
    shape_ = file_.shape_of("transmission_loss");
    state_ = file_.read("position_state");
    north_m_ = file_.read("position_north");
    east_m_ = file_.read("position_east");
    range_m_ = file_.read("range");
    depth_m_ = file_.read("depth");
  }

  [[nodiscard]] std::size_t positions() const { return shape_[0]; }
  [[nodiscard]] bool has_water(std::size_t position) const { return state_[position] != static_cast<double>(PositionState::kNoWater); }
  [[nodiscard]] double bytes() const {
    double bytes = sizeof(float);
    for (const std::size_t length : shape_) bytes *= static_cast<double>(length);
    return bytes;
  }
  [[nodiscard]] double number(const std::string& variable) const { return file_.read(variable).at(0); }
  [[nodiscard]] std::vector<double> numbers(const std::string& variable) const { return file_.read(variable); }
  [[nodiscard]] Centre centre() const {
    return file_.text_attribute("depth", "long_name") == "depth of the source" ? Centre::kHydrophone : Centre::kSource;
  }
  [[nodiscard]] netcdf::FileError error(const std::string& variable, const std::string& what) const { return file_.error(variable, what); }

  [[nodiscard]] Fan fan(std::size_t position) const {
    if (position >= positions()) throw error("transmission_loss", "has no position " + std::to_string(position));
    if (state_[position] != static_cast<double>(PositionState::kDone))
      throw error("position_state", "position " + std::to_string(position) + " has no field");
    const auto loss = file_.read("transmission_loss", {.start = {position, 0, 0, 0}, .count = {1, shape_[1], shape_[2], shape_[3]}});
    return {.centre = {Meters{north_m_[position]}, Meters{east_m_[position]}},
            .bearings = shape_[1],
            .ranges = shape_[2],
            .range_step = Meters{range_m_.front()},
            .depth_m = depth_m_,
            .transmission_loss_db = std::vector<float>(loss.begin(), loss.end()),
            .sea_floor_depth_m = {}};
  }

 private:
  netcdf::Reader file_;
  std::vector<std::size_t> shape_;
  std::vector<double> state_, north_m_, east_m_, range_m_, depth_m_;
};

}  // namespace

FieldLibrary::FieldLibrary(const std::filesystem::path& path) {
  const LibraryFile file(path);
  if (file.bytes() > kMostBytes) throw file.error("transmission_loss", "is larger than the 2 GiB that are kept in memory");
  for (std::size_t position = 0; position < file.positions(); ++position) {
    if (file.has_water(position)) fans_.push_back(file.fan(position));
  }
  if (fans_.empty()) throw file.error("position_state", "no position has a field");
  centre_ = file.centre();
  centre_depth_ = Meters{file.number("position_depth")};
  frequency_hz_ = file.numbers("frequency");
  if (frequency_hz_.empty()) throw file.error("frequency", "holds none");
}

Fan read_library_fan(const std::filesystem::path& path, std::size_t position) {
  return LibraryFile(path).fan(position);
}

}  // namespace earshot::sonar
