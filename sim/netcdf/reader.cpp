#include "sim/netcdf/reader.hpp"

#include <netcdf.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <utility>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "sim/netcdf/classic_size.hpp"
#include "sim/netcdf/library_exit.hpp"

namespace earshot::netcdf {
namespace {

constexpr std::size_t kMostValues = std::size_t{1} << 28;  // 2 GiB of doubles: beyond it stands a corrupt header or a forgotten window

/// The library opens files by name; what it is given is a regular file that can be read.
host::InputFile opened(const std::filesystem::path& path) try { return {path, host::kAnySize}; } catch (const host::BadInput& e) {
  throw FileError(e.what());
}

bool is_classic(host::InputFile& file) {
  std::array<std::uint8_t, 3> magic{};
  return file.read(magic) == magic.size() && magic == std::array<std::uint8_t, 3>{'C', 'D', 'F'};
}

}  // namespace

FileError Reader::error(const std::string& variable, const std::string& what) const {
  return FileError(path_.string() + ": " + (variable.empty() ? "" : variable + ": ") + what);
}

Reader::Reader(std::filesystem::path path) : path_(std::move(path)) {
  if (host::InputFile file = opened(path_); is_classic(file)) {
    const std::optional<std::uint64_t> needed = classic_size(path_);
    const std::uint64_t bytes = file.size();
    if (!needed) throw error("", "its NetCDF header is damaged or truncated");
    if (bytes < *needed) {
      throw error("", "truncated: has " + std::to_string(bytes) + " bytes, its header promises " + std::to_string(*needed));
    }
  }
  leave_hdf5_alone_at_exit();
  const int status = nc_open(path_.c_str(), NC_NOWRITE, &file_);
  if (status != NC_NOERR) throw error("", std::string("not a whole NetCDF file (") + nc_strerror(status) + ")");
}

Reader::~Reader() {
  (void)nc_close(file_);
}

int Reader::variable_id(const std::string& variable) const {
  int id = -1;
  if (nc_inq_varid(file_, variable.c_str(), &id) != NC_NOERR) throw error(variable, "no such variable");
  return id;
}

bool Reader::has_variable(const std::string& variable) const {
  int id = -1;
  return nc_inq_varid(file_, variable.c_str(), &id) == NC_NOERR;
}

std::vector<std::string> Reader::dimensions_of(const std::string& variable) const {
  const int id = variable_id(variable);
  int rank = 0;
  std::vector<int> dimensions(NC_MAX_VAR_DIMS);
  if (nc_inq_var(file_, id, nullptr, nullptr, &rank, dimensions.data(), nullptr) != NC_NOERR) throw error(variable, "cannot be read");
  std::vector<std::string> names;
  for (int i = 0; i < rank; ++i) {
    std::array<char, NC_MAX_NAME + 1> name{};
    if (nc_inq_dimname(file_, dimensions[static_cast<std::size_t>(i)], name.data()) != NC_NOERR) throw error(variable, "cannot be read");
    names.emplace_back(name.data());
  }
  return names;
}

std::vector<std::size_t> Reader::shape_of(const std::string& variable) const {
  std::vector<std::size_t> shape;
  for (const std::string& name : dimensions_of(variable)) {
    int id = -1;
    std::size_t length = 0;
    if (nc_inq_dimid(file_, name.c_str(), &id) != NC_NOERR || nc_inq_dimlen(file_, id, &length) != NC_NOERR) {
      throw error(variable, "its dimension " + host::printable(name) + " cannot be read");
    }
    shape.push_back(length);
  }
  return shape;
}

std::optional<std::string> Reader::text_attribute(const std::string& variable, const std::string& attribute) const {
  const int id = variable_id(variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file_, id, attribute.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR) return std::nullopt;
  std::string text(length, '\0');
  if (nc_get_att_text(file_, id, attribute.c_str(), text.data()) != NC_NOERR) throw error(variable, attribute + " cannot be read");
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

std::optional<double> Reader::number_attribute(int variable_id, const char* attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  double value = 0.0;
  if (nc_inq_att(file_, variable_id, attribute, &type, &length) != NC_NOERR || length != 1 || type == NC_CHAR) return std::nullopt;
  return nc_get_att_double(file_, variable_id, attribute, &value) == NC_NOERR ? std::optional(value) : std::nullopt;
}

std::vector<double> Reader::read(const std::string& variable) const {
  const std::vector<std::size_t> shape = shape_of(variable);
  return read(variable, {.start = std::vector<std::size_t>(shape.size(), 0), .count = shape});
}

std::vector<double> Reader::read(const std::string& variable, const Block& block) const {
  const int id = variable_id(variable);
  const std::vector<std::size_t> shape = shape_of(variable);
  std::size_t values = 1;
  if (block.start.size() != shape.size() || block.count.size() != shape.size()) throw error(variable, "has another number of dimensions");
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (block.start[i] > shape[i] || block.count[i] > shape[i] - block.start[i]) throw error(variable, "is smaller than asked for");
    if (block.count[i] > 0 && values > kMostValues / block.count[i]) throw error(variable, "is larger than 2^28 values");
    values *= block.count[i];
  }
  std::vector<double> data(values);
  const int status = nc_get_vara_double(file_, id, block.start.data(), block.count.data(), data.data());
  if (status != NC_NOERR) throw error(variable, std::string("cannot be read (") + nc_strerror(status) + ")");

  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double fill = number_attribute(id, "_FillValue").value_or(kNone);  // no value equals NaN
  const double missing = number_attribute(id, "missing_value").value_or(kNone);
  const double scale = number_attribute(id, "scale_factor").value_or(1.0);
  const double offset = number_attribute(id, "add_offset").value_or(0.0);
  for (double& x : data) {
    x = x == fill || x == missing ? kNone : x * scale + offset;
  }
  return data;
}

FileError Reader::error(const std::string& variable, const Block& block, std::size_t index, double value, const std::string& what) const {
  std::string place;
  for (std::size_t d = block.count.size(); d-- > 0;) {
    place = std::to_string(block.start[d] + index % block.count[d]) + (place.empty() ? "" : ", ") + place;
    index /= block.count[d];
  }
  std::ostringstream text;
  text << path_.string() << ": " << variable << (place.empty() ? "" : "[" + place + "]") << " = " << value << ": " << what;
  return FileError(text.str());
}

void Reader::require(const std::string& variable, const Block& block, std::span<const double> values, const host::Range& allowed,
                     Missing missing) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (allowed.allows(values[i]) || (missing == Missing::kAllowed && std::isnan(values[i]))) continue;
    throw error(variable, block, i, values[i], to_string(allowed) + (missing == Missing::kAllowed ? ", or missing (_FillValue)" : ""));
  }
}

void Reader::require(const std::string& variable, std::span<const double> values, const host::Range& allowed) const {
  require(variable, {.start = {0}, .count = {values.size()}}, values, allowed);
}

}  // namespace earshot::netcdf
