#include "sim/netcdf/resumable_file.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "sim/netcdf/library_exit.hpp"
#include "sim/netcdf/library_type.hpp"

namespace earshot::netcdf {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& variable, const std::string& what) {
  throw FileError(path.string() + ": " + (variable.empty() ? "" : variable + ": ") + what);
}

void require(int status, const std::filesystem::path& path, const std::string& variable = "") {
  if (status != NC_NOERR) fail(path, variable, std::string("cannot be written (") + nc_strerror(status) + ")");
}

void require_flushed(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  const bool flushed = descriptor >= 0 && fsync(descriptor) == 0;
  const int cause = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) fail(path, "", std::string("cannot be written (") + std::strerror(cause) + ")");
}

/// Renames for good: the folder's entry is on the disk too.
void rename_and_flush(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code failed;
  std::filesystem::rename(from, to, failed);
  if (failed) fail(to, "", "cannot be written (" + failed.message() + ")");
  require_flushed(std::filesystem::absolute(to).parent_path());
}

void define(int file, const Layout& layout, const std::filesystem::path& path) {
  for (const auto& [key, value] : layout.attributes)
    require(nc_put_att_text(file, NC_GLOBAL, key.c_str(), value.size(), value.data()), path, key);
  for (const auto& [name, length] : layout.dimensions) {
    int id = -1;
    require(nc_def_dim(file, name.c_str(), length, &id), path, name);
  }
  for (const VariableLayout& variable : layout.variables) {
    std::vector<int> ids(variable.dimensions.size());
    for (std::size_t i = 0; i < ids.size(); ++i) require(nc_inq_dimid(file, variable.dimensions[i].c_str(), &ids[i]), path, variable.name);
    int id = -1;
    const nc_type type = nc_type_of(variable.type);
    require(nc_def_var(file, variable.name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &id), path, variable.name);
    for (const auto& [key, value] : variable.attributes)
      require(nc_put_att_text(file, id, key.c_str(), value.size(), value.data()), path, variable.name);
    if (variable.fill) require(nc_put_att_double(file, id, "_FillValue", type, 1, &*variable.fill), path, variable.name);
    const std::vector<double>& flags = variable.flag_values;
    if (!flags.empty()) require(nc_put_att_double(file, id, "flag_values", type, flags.size(), flags.data()), path, variable.name);
  }
}

/// A descriptor of the file that `path` names, under a lock that falls with the process.
int locked(const std::filesystem::path& path, int more_flags = 0) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC | more_flags, 0666);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  if (descriptor == -1) fail(path, "", std::string("cannot be written (") + std::strerror(errno) + ")");
  // Not lockf: such a lock falls when the process closes any descriptor of the file, as nc_open does after its first read.
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  const bool mine = fcntl(descriptor, F_OFD_SETLK, &whole) == 0;  // NOLINT(cppcoreguidelines-pro-type-vararg)
  const int cause = errno;
  std::error_code ignored;  // another process may have renamed the file between open and lock
  if (mine && std::filesystem::equivalent(path, "/proc/self/fd/" + std::to_string(descriptor), ignored)) return descriptor;
  ::close(descriptor);
  const bool taken = mine || cause == EAGAIN || cause == EACCES;
  fail(path, "", taken ? "another process is writing it" : std::string("cannot be locked (") + std::strerror(cause) + ")");
}

void write_draft(const std::filesystem::path& draft, const Layout& layout) {
  int file = -1;
  try {
    require(nc_create(draft.c_str(), NC_64BIT_DATA | NC_CLOBBER, &file), draft);  // in the locked file: it is truncated, not replaced
    define(file, layout, draft);
    require(nc_enddef(file), draft);  // writes the fill values of all variables
    require(nc_close(std::exchange(file, -1)), draft);
    require_flushed(draft);
  } catch (const FileError&) {
    if (file != -1) (void)nc_abort(file);
    throw;
  }
}

/// Makes the file with its fill values under a third name, so that what bears the second is never half made.
/// @return its locked descriptor
int begin(const std::filesystem::path& partial, const Layout& layout) {
  std::filesystem::path draft = partial;
  draft += ".new";
  const int descriptor = locked(draft, O_CREAT);
  try {
    if (std::filesystem::exists(partial)) fail(partial, "", "another process is writing it");  // since we looked
    write_draft(draft, layout);
    rename_and_flush(draft, partial);
    return descriptor;
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(draft, ignored);
    ::close(descriptor);
    throw;
  }
}

/// What differs between a file and a layout; empty if nothing that matters does.
std::string difference(int file, const Layout& layout) {
  for (const auto& [key, value] : layout.attributes) {
    std::size_t length = 0;
    if (nc_inq_attlen(file, NC_GLOBAL, key.c_str(), &length) != NC_NOERR) return key;
    std::string there(length, '\0');
    if (nc_get_att_text(file, NC_GLOBAL, key.c_str(), there.data()) != NC_NOERR || there != value) return key;
  }
  for (const auto& [name, length] : layout.dimensions) {
    int id = -1;
    std::size_t there = 0;
    if (nc_inq_dimid(file, name.c_str(), &id) != NC_NOERR || nc_inq_dimlen(file, id, &there) != NC_NOERR || there != length) return name;
  }
  for (const VariableLayout& variable : layout.variables) {
    int id = -1;
    if (nc_inq_varid(file, variable.name.c_str(), &id) != NC_NOERR) return variable.name;
  }
  return "";
}

}  // namespace

ResumableFile::ResumableFile(std::filesystem::path path, const Layout& layout) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  leave_hdf5_alone_at_exit();
  descriptor_ = std::filesystem::exists(partial_) ? locked(partial_) : begin(partial_, layout);
  try {
    if (std::filesystem::exists(path_)) fail(path_, "", "stands there already");
    (void)Reader(partial_);  // refuses what is truncated or no NetCDF file
    check(nc_open(partial_.c_str(), NC_WRITE, &file_), "");
    const std::string what = difference(file_, layout);
    if (!what.empty()) fail(partial_, what, "it was begun with another; move or delete the file to begin anew");
  } catch (...) {
    close();
    throw;
  }
}

ResumableFile::~ResumableFile() {
  close();
}

void ResumableFile::close() {
  if (file_ != -1) (void)nc_close(std::exchange(file_, -1));
  if (descriptor_ != -1) ::close(std::exchange(descriptor_, -1));
}

bool ResumableFile::is_finished(const std::filesystem::path& path, const Layout& layout) {
  if (!std::filesystem::exists(path)) return false;
  (void)Reader(path);  // refuses what is truncated or no NetCDF file
  int file = -1;
  require(nc_open(path.c_str(), NC_NOWRITE, &file), path);
  const std::string what = difference(file, layout);
  (void)nc_close(file);
  if (!what.empty()) fail(path, what, "stands there already and was made with another; move or delete it, or choose another name");
  return true;
}

void ResumableFile::check(int status, const std::string& variable) const {
  require(status, partial_, variable);
}

int ResumableFile::variable_id(const std::string& variable) const {
  int id = -1;
  check(nc_inq_varid(file_, variable.c_str(), &id), variable);
  return id;
}

std::vector<double> ResumableFile::read(const std::string& variable) const {
  const int id = variable_id(variable);
  int rank = 0;
  std::vector<int> dimensions(NC_MAX_VAR_DIMS);
  check(nc_inq_var(file_, id, nullptr, nullptr, &rank, dimensions.data(), nullptr), variable);
  std::size_t size = 1;
  for (int i = 0; i < rank; ++i) {
    std::size_t length = 0;
    check(nc_inq_dimlen(file_, dimensions[static_cast<std::size_t>(i)], &length), variable);
    size *= length;
  }
  std::vector<double> values(size);
  check(nc_get_var_double(file_, id, values.data()), variable);
  return values;
}

void ResumableFile::write(const std::string& variable, const Block& block, std::span<const float> values) {
  check(nc_put_vara_float(file_, variable_id(variable), block.start.data(), block.count.data(), values.data()), variable);
}

void ResumableFile::write(const std::string& variable, const Block& block, std::span<const double> values) {
  check(nc_put_vara_double(file_, variable_id(variable), block.start.data(), block.count.data(), values.data()), variable);
}

void ResumableFile::flush() {
  check(nc_sync(file_), "");
  if (fsync(descriptor_) != 0) fail(partial_, "", std::string("cannot be written (") + std::strerror(errno) + ")");
}

void ResumableFile::commit() {
  flush();
  check(nc_close(std::exchange(file_, -1)), "");
  rename_and_flush(partial_, path_);
  close();
}

}  // namespace earshot::netcdf
