#include "sim/netcdf/writer.hpp"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "sim/netcdf/library_exit.hpp"
#include "sim/netcdf/library_type.hpp"

namespace earshot::netcdf {
namespace {

/// The library says "Permission denied" of a file that it cannot begin and "HDF error" of one that it cannot go on with, whatever the disk
/// did. @param cause  errno, as the call of the system left it that failed last; 0: none has
std::string reason_of(int status, int cause) {
  const bool is_of_the_disk = cause == ENOSPC || cause == EDQUOT || cause == EFBIG || cause == EIO || cause == EROFS;
  return is_of_the_disk ? std::strerror(cause) : nc_strerror(status);
}

}  // namespace

Writer::Writer(std::filesystem::path path) : path_(std::move(path)), whole_(path_) {
  leave_hdf5_alone_at_exit();
  errno = 0;
  check(nc_create(whole_.partial().c_str(), NC_NETCDF4 | NC_CLOBBER, &file_), "");
}

Writer::~Writer() {
  if (file_ != -1) (void)nc_close(file_);
}

void Writer::check(int status, const std::string& variable) const {
  const int cause = std::exchange(errno, 0);
  if (status == NC_NOERR) return;
  throw FileError(path_.string() + ": " + (variable.empty() ? "" : variable + ": ") + "cannot be written (" + reason_of(status, cause) +
                  ")");
}

int Writer::variable_id(const std::string& variable) const {
  int id = -1;
  check(nc_inq_varid(file_, variable.c_str(), &id), variable);
  return id;
}

void Writer::dimension(const std::string& name, std::size_t length) {
  int id = -1;
  check(nc_def_dim(file_, name.c_str(), length, &id), name);
}

void Writer::variable(const std::string& name, Type type, const std::vector<std::string>& dimensions, const Attributes& attributes) {
  std::vector<int> ids(dimensions.size());
  for (std::size_t i = 0; i < ids.size(); ++i) check(nc_inq_dimid(file_, dimensions[i].c_str(), &ids[i]), name);
  int id = -1;
  check(nc_def_var(file_, name.c_str(), nc_type_of(type), static_cast<int>(ids.size()), ids.data(), &id), name);
  for (const auto& [key, value] : attributes) check(nc_put_att_text(file_, id, key.c_str(), value.size(), value.data()), name);
}

void Writer::compress(const std::string& variable) {
  constexpr std::size_t kChunkValues = 16'384;
  std::vector<std::size_t> chunk = all_of(variable).count;
  std::size_t values = 1;
  for (auto length = chunk.rbegin(); length != chunk.rend(); ++length) {
    *length = std::min(*length, std::max<std::size_t>(1, kChunkValues / values));
    values *= *length;
  }
  const int id = variable_id(variable);
  check(nc_def_var_chunking(file_, id, NC_CHUNKED, chunk.data()), variable);
  check(nc_def_var_deflate(file_, id, NC_SHUFFLE, 1, 1), variable);
}

void Writer::attribute(const std::string& name, const std::string& value) {
  check(nc_put_att_text(file_, NC_GLOBAL, name.c_str(), value.size(), value.data()), name);
}

void Writer::attribute(const std::string& name, double value) {
  check(nc_put_att_double(file_, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &value), name);
}

void Writer::attribute(const std::string& variable, const std::string& name, double value) {
  const int id = variable_id(variable);
  nc_type type = NC_NAT;
  check(nc_inq_vartype(file_, id, &type), variable);
  const nc_type of_attribute = name == "_FillValue" ? type : NC_DOUBLE;  // a fill value has its variable's type
  check(nc_put_att_double(file_, id, name.c_str(), of_attribute, 1, &value), variable);
}

Block Writer::all_of(const std::string& variable) const {
  int rank = 0;
  std::array<int, NC_MAX_VAR_DIMS> dimensions{};
  check(nc_inq_var(file_, variable_id(variable), nullptr, nullptr, &rank, dimensions.data(), nullptr), variable);
  Block all;
  for (int i = 0; i < rank; ++i) {
    all.start.push_back(0);
    check(nc_inq_dimlen(file_, dimensions[static_cast<std::size_t>(i)], &all.count.emplace_back()), variable);
  }
  return all;
}

void Writer::check_size(const std::string& variable, const Block& block, std::size_t values) const {
  std::size_t needed = 1;
  for (const std::size_t count : block.count) needed *= count;
  if (values != needed) {
    throw FileError(path_.string() + ": " + variable + ": got " + std::to_string(values) + " values for " + std::to_string(needed));
  }
}

void Writer::write(const std::string& variable, std::span<const double> values) {
  write(variable, all_of(variable), values);
}

void Writer::write(const std::string& variable, std::span<const float> values) {
  write(variable, all_of(variable), values);
}

void Writer::write(const std::string& variable, const Block& block, std::span<const double> values) {
  check_size(variable, block, values.size());
  check(nc_put_vara_double(file_, variable_id(variable), block.start.data(), block.count.data(), values.data()), variable);
}

void Writer::write(const std::string& variable, const Block& block, std::span<const float> values) {
  check_size(variable, block, values.size());
  check(nc_put_vara_float(file_, variable_id(variable), block.start.data(), block.count.data(), values.data()), variable);
}

void Writer::commit() {
  const int file = std::exchange(file_, -1);
  check(nc_close(file), "");
  whole_.commit(host::OutputFile::Survives::kProcess);
}

}  // namespace earshot::netcdf
