#include "sim/field_library/library_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "sim/sonar/sonar_field.hpp"

namespace earshot::field_library {
namespace {

using host::Range;

constexpr double kMostBytes = 2147483648.0;

/// A file holds its values in four bytes each, or in eight if another program made it; beside them stand the axes of a million positions
/// (20 MB) and some text.
constexpr double kMostBytesPerValue = 8.0;
constexpr double kMostOtherBytes = 64.0 * 1024 * 1024;

// What load_library_plan allows, and so all that a library can hold.
const Range kInPlane_m = Range::between(-kFurthestPosition_m, kFurthestPosition_m);
const Range kRange_m = Range::between(0.01, 2'000'000.0);
const Range kDepth_m = Range::above_up_to(0.0, 12'000.0);

/// At 1 m it is 0, at 1 cm -40, and sound that comes together from several ways gives some more; the writer's cap is the greatest.
const Range kLoss_db = Range::between(-60.0, sonar::kMaxTransmissionLoss.value);

// What an environment file allows.
const Range kSourceLevel_db = Range::between(0.0, 300.0);
const Range kNoiseLevel_db = Range::between(-100.0, 300.0);

}  // namespace

LibraryFile::LibraryFile(const std::filesystem::path& path) : file_(path) {
  if (file_.dimensions_of("transmission_loss") != std::vector<std::string>{"position", "bearing", "range", "depth"})
    throw file_.error("transmission_loss", "must have the dimensions (position, bearing, range, depth)");
  shape_ = file_.shape_of("transmission_loss");
  if (std::ranges::find(shape_, 0U) != shape_.end()) throw file_.error("transmission_loss", "has no values");
  if (shape_[0] > kMostPositions || values_of_fan() > sonar::kMostFanValues)
    throw file_.error("transmission_loss", "is larger than a library can be: 1 million positions of 64 million values each");
  state_ = axis("position_state", shape_[0], Range::between(0.0, 2.0));
  north_m_ = axis("position_north", shape_[0], kInPlane_m);
  east_m_ = axis("position_east", shape_[0], kInPlane_m);
  range_m_ = axis("range", shape_[2], kRange_m);
  depth_m_ = axis("depth", shape_[3], kDepth_m);
  require_even_ranges();
  require_increasing("depth", depth_m_);
}

Meters LibraryFile::centre_depth() const {
  return Meters{axis("position_depth", 1, kDepth_m).front()};
}

std::vector<double> LibraryFile::frequency_hz() const {
  if (const std::size_t values = size_of("frequency"); values == 0 || values > kMostFrequencies)
    throw file_.error("frequency", "holds " + std::to_string(values) + ": must be 1 to " + std::to_string(kMostFrequencies));
  std::vector<double> frequency_hz = file_.read("frequency");
  file_.require("frequency", frequency_hz, Range::between(1.0, 10'000.0));
  require_increasing("frequency", frequency_hz);
  return frequency_hz;
}

Decibels LibraryFile::source_level() const {
  return Decibels{axis("source_level", 1, kSourceLevel_db).front()};
}

Decibels LibraryFile::noise_level() const {
  return Decibels{axis("noise_level", 1, kNoiseLevel_db).front()};
}

Centre LibraryFile::centre() const {
  return file_.text_attribute("depth", "long_name") == "depth of the source" ? Centre::kHydrophone : Centre::kSource;
}

void LibraryFile::require_room(std::size_t positions) const {
  if (static_cast<double>(positions) * values_of_fan() * sizeof(float) > kMostBytes)
    throw file_.error("transmission_loss", "is larger than the 2 GiB that are kept in memory");
  const double values = static_cast<double>(shape_[0]) * values_of_fan();
  const std::uintmax_t bytes = std::filesystem::file_size(file_.path());
  if (static_cast<double>(bytes) > values * kMostBytesPerValue + kMostOtherBytes)
    throw file_.error("", "has " + std::to_string(bytes) + " bytes, many more than its header promises");
}

sonar::Fan LibraryFile::fan(std::size_t position) const {
  if (position >= positions()) throw error("transmission_loss", "has no position " + std::to_string(position));
  if (state_[position] != static_cast<double>(PositionState::kDone))
    throw error("position_state", "position " + std::to_string(position) + " has no field");
  const netcdf::Block block{.start = {position, 0, 0, 0}, .count = {1, shape_[1], shape_[2], shape_[3]}};
  const auto loss = file_.read("transmission_loss", block);
  file_.require("transmission_loss", block, loss, kLoss_db, netcdf::Missing::kAllowed);
  require_no_gaps(block, loss);
  return {.centre = {Meters{north_m_[position]}, Meters{east_m_[position]}},
          .bearings = shape_[1],
          .ranges = shape_[2],
          .range_step = Meters{range_m_.front()},
          .depth_m = depth_m_,
          .transmission_loss_db = std::vector<float>(loss.begin(), loss.end()),
          .sea_floor_depth_m = {}};
}

double LibraryFile::values_of_fan() const {
  return static_cast<double>(shape_[1]) * static_cast<double>(shape_[2]) * static_cast<double>(shape_[3]);
}

std::size_t LibraryFile::size_of(const std::string& variable) const {
  std::size_t size = 1;
  for (const std::size_t length : file_.shape_of(variable)) {
    if (length != 0 && size > std::numeric_limits<std::size_t>::max() / length) throw file_.error(variable, "is too large");
    size *= length;
  }
  return size;
}

std::vector<double> LibraryFile::axis(const std::string& variable, std::size_t size, const Range& allowed) const {
  if (size_of(variable) != size) throw file_.error(variable, "must have " + std::to_string(size) + " values");
  std::vector<double> values = file_.read(variable);
  file_.require(variable, values, allowed);
  return values;
}

void LibraryFile::require_increasing(const std::string& variable, const std::vector<double>& values) const {
  if (!std::ranges::is_sorted(values, std::less_equal<>{})) throw file_.error(variable, "must increase throughout");
}

void LibraryFile::require_even_ranges() const {
  for (std::size_t i = 0; i < range_m_.size(); ++i) {
    const double expected_m = static_cast<double>(i + 1) * range_m_.front();
    if (!(std::abs(range_m_[i] - expected_m) <= 1e-6 * expected_m))  // rounding
      throw file_.error("range", {.start = {0}, .count = {range_m_.size()}}, i, range_m_[i], "must be " + std::to_string(expected_m));
  }
}

/// A missing value means that there is no water: none is above one that is there.
void LibraryFile::require_no_gaps(const netcdf::Block& block, const std::vector<double>& loss) const {
  const std::size_t depths = shape_[3];
  for (std::size_t i = 0; i < loss.size(); ++i) {
    if (std::isnan(loss[i]) && i % depths + 1 < depths && !std::isnan(loss[i + 1]))
      throw file_.error("transmission_loss", block, i, loss[i], "must be there, because there is one deeper");
  }
}

}  // namespace earshot::field_library
