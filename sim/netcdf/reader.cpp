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
#include "sim/netcdf/apart.hpp"
#include "sim/netcdf/classic_size.hpp"
#include "sim/netcdf/library_exit.hpp"
#include "sim/netcdf/packing.hpp"
#include "sim/netcdf/text_attribute.hpp"

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

/// What the library reads of a file when it is opened and asked for its variables and attributes; whether it succeeds is not told.
void look_through(const std::filesystem::path& path) {
  int file = -1;
  if (nc_open(path.c_str(), NC_NOWRITE, &file) != NC_NOERR) return;
  int variables = 0;
  (void)nc_inq_nvars(file, &variables);
  for (int id = 0; id < variables; ++id) {
    int attributes = 0;
    (void)nc_inq_varnatts(file, id, &attributes);
    for (int i = 0; i < attributes; ++i) {
      std::array<char, NC_MAX_NAME + 1> name{};
      if (nc_inq_attname(file, id, i, name.data()) == NC_NOERR) (void)text_attribute(file, id, name.data());
    }
    (void)Packing(file, id);
  }
  (void)nc_close(file);
}

/// 10 million values a second are read from a compressed file that is not damaged; a loop without end is noticed in ten seconds.
ApartLimits limits_for(std::size_t values) {
  return {.processor_time_s = static_cast<unsigned>(10 + values / 1'000'000)};
}

}  // namespace

void Reader::require_sound(const std::optional<std::string>& end) const {
  if (end) throw error("", "is damaged: reading it ended with " + *end);
}

FileError Reader::error(const std::string& variable, const std::string& what) const {
  return FileError(path_.string() + ": " + (variable.empty() ? "" : variable + ": ") + what);
}

Reader::Reader(std::filesystem::path path) : path_(std::move(path)) {
  host::InputFile input = opened(path_);
  is_hdf5_ = !is_classic(input);
  if (!is_hdf5_) {
    const std::optional<std::uint64_t> needed = classic_size(path_);
    const std::uint64_t bytes = input.size();
    if (!needed) throw error("", "its NetCDF header is damaged or truncated");
    if (bytes < *needed) {
      throw error("", "truncated: has " + std::to_string(bytes) + " bytes, its header promises " + std::to_string(*needed));
    }
  }
  leave_hdf5_alone_at_exit();
  if (is_hdf5_) require_sound(run_apart(limits_for(0), [this] { look_through(path_); }));
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
  return netcdf::text_attribute(file_, variable_id(variable), attribute.c_str());
}

int Reader::get(int variable_id, const Block& block, std::vector<double>& data) const {
  const auto read_into = [&](double* values) {
    return nc_get_vara_double(file_, variable_id, block.start.data(), block.count.data(), values);
  };
  if (!is_hdf5_) return read_into(data.data());
  const SharedBytes status(sizeof(int));
  const SharedBytes values(data.size() * sizeof(double));
  if (status.data() == nullptr || values.data() == nullptr) return NC_ENOMEM;
  auto* const read_status = static_cast<int*>(status.data());
  const auto* const read_values = static_cast<const double*>(values.data());
  require_sound(run_apart(limits_for(data.size()), [&] { *read_status = read_into(static_cast<double*>(values.data())); }));
  data.assign(read_values, read_values + data.size());
  return *read_status;
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
  if (const int status = get(id, block, data); status != NC_NOERR)
    throw error(variable, std::string("cannot be read (") + nc_strerror(status) + ")");
  const Packing packing(file_, id);
  for (double& x : data) x = packing.value_of(x);
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
