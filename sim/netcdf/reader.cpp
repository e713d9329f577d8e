#include "sim/netcdf/reader.hpp"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <sstream>
#include <utility>

#include "firmware/host/file/input_file.hpp"
#include "sim/netcdf/apart.hpp"
#include "sim/netcdf/classic_size.hpp"
#include "sim/netcdf/library_exit.hpp"
#include "sim/netcdf/packing.hpp"

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

/// 10 million values a second are read from a compressed file that is not damaged; a loop without end is noticed in ten seconds.
ApartLimits limits_for(std::size_t values) {
  return {.processor_time_s = static_cast<unsigned>(10 + values / 1'000'000)};
}

/// What a child tells of a file before the bytes of its header.
struct ChildAnswer {
  int status = NC_NOERR;
  std::size_t header_bytes = 0;
};

/// The largest header of a real file has some kilobytes.
constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 20U;

}  // namespace

/// An open file of the library; it is closed when this goes.
class Reader::OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : status_(nc_open(path.c_str(), NC_NOWRITE, &file_)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (status_ == NC_NOERR) (void)nc_close(file_);
  }

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] Header header() const { return read_header(file_); }

  /// @return the library's status
  [[nodiscard]] int read(const std::string& variable, const Block& block, std::span<double> values) const {
    int id = -1;
    if (status_ != NC_NOERR) return status_;
    if (const int status = nc_inq_varid(file_, variable.c_str(), &id); status != NC_NOERR) return status;
    if (const int status = nc_get_vara_double(file_, id, block.start.data(), block.count.data(), values.data()); status != NC_NOERR)
      return status;
    const Packing packing(file_, id);
    for (double& x : values) x = packing.value_of(x);
    return NC_NOERR;
  }

 private:
  int file_ = -1;
  int status_;
};

void Reader::require_sound(const std::optional<std::string>& end) const {
  if (end) throw error("", "is damaged: reading it ended with " + *end);
}

void Reader::require_open(int status) const {
  if (status != NC_NOERR) throw error("", std::string("not a whole NetCDF file (") + nc_strerror(status) + ")");
}

FileError Reader::error(const std::string& variable, const std::string& what) const {
  return FileError(path_.string() + ": " + (variable.empty() ? "" : variable + ": ") + what);
}

Reader::Reader(std::filesystem::path path) : path_(std::move(path)) {
  host::InputFile input = opened(path_);
  const bool is_hdf5 = !is_classic(input);
  if (!is_hdf5) {
    const std::optional<std::uint64_t> needed = classic_size(path_);
    const std::uint64_t bytes = input.size();
    if (!needed) throw error("", "its NetCDF header is damaged or truncated");
    if (bytes < *needed) {
      throw error("", "truncated: has " + std::to_string(bytes) + " bytes, its header promises " + std::to_string(*needed));
    }
  }
  leave_hdf5_alone_at_exit();
  if (!is_hdf5) {
    classic_ = std::make_unique<OpenFile>(path_);
    require_open(classic_->status());
  }
  header_ = is_hdf5 ? header_apart() : classic_->header();
}

Reader::~Reader() = default;

Header Reader::header_apart() const {
  const SharedBytes shared(sizeof(ChildAnswer) + kMostHeaderBytes);
  if (shared.data() == nullptr) throw error("", "cannot be read: no memory for it");
  auto* const answer = new (shared.data()) ChildAnswer;
  char* const bytes = static_cast<char*>(shared.data()) + sizeof(ChildAnswer);
  require_sound(run_apart(limits_for(0), [&] {
    const OpenFile file(path_);
    answer->status = file.status();
    if (answer->status != NC_NOERR) return;
    const std::string header = to_bytes(file.header());
    answer->header_bytes = header.size();
    if (header.size() <= kMostHeaderBytes) std::ranges::copy(header, bytes);
  }));
  require_open(answer->status);
  if (answer->header_bytes > kMostHeaderBytes) throw error("", "is damaged: its names and texts are longer than 16 MiB");
  std::optional<Header> header = header_from({bytes, answer->header_bytes});
  if (!header) throw error("", "is damaged: its header cannot be read");
  return *std::move(header);
}

const Variable& Reader::find(const std::string& variable) const {
  const auto found = header_.find(variable);
  if (found == header_.end()) throw error(variable, "no such variable");
  return found->second;
}

bool Reader::has_variable(const std::string& variable) const {
  return header_.contains(variable);
}

std::vector<std::string> Reader::dimensions_of(const std::string& variable) const {
  std::vector<std::string> names;
  for (const Dimension& dimension : find(variable).dimensions) names.push_back(dimension.name);
  return names;
}

std::vector<std::size_t> Reader::shape_of(const std::string& variable) const {
  std::vector<std::size_t> shape;
  for (const Dimension& dimension : find(variable).dimensions) shape.push_back(dimension.length);
  return shape;
}

std::optional<std::string> Reader::text_attribute(const std::string& variable, const std::string& attribute) const {
  const std::map<std::string, std::string>& texts = find(variable).texts;
  const auto found = texts.find(attribute);
  return found == texts.end() ? std::nullopt : std::optional(found->second);
}

int Reader::get(const std::string& variable, const Block& block, std::vector<double>& values) const {
  if (classic_) return classic_->read(variable, block, values);
  const SharedBytes status(sizeof(int));
  const SharedBytes shared(values.size() * sizeof(double));
  if (status.data() == nullptr || shared.data() == nullptr) return NC_ENOMEM;
  auto* const read_status = static_cast<int*>(status.data());
  const std::span read_values(static_cast<double*>(shared.data()), values.size());
  require_sound(run_apart(limits_for(values.size()), [&] { *read_status = OpenFile(path_).read(variable, block, read_values); }));
  values.assign(read_values.begin(), read_values.end());
  return *read_status;
}

std::vector<double> Reader::read(const std::string& variable) const {
  const std::vector<std::size_t> shape = shape_of(variable);
  return read(variable, {.start = std::vector<std::size_t>(shape.size(), 0), .count = shape});
}

std::vector<double> Reader::read(const std::string& variable, const Block& block) const {
  const std::vector<std::size_t> shape = shape_of(variable);
  if (const std::string& fault = find(variable).packing_fault; !fault.empty()) throw error(variable, fault);
  std::size_t values = 1;
  if (block.start.size() != shape.size() || block.count.size() != shape.size()) throw error(variable, "has another number of dimensions");
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (block.start[i] > shape[i] || block.count[i] > shape[i] - block.start[i]) throw error(variable, "is smaller than asked for");
    if (block.count[i] > 0 && values > kMostValues / block.count[i]) throw error(variable, "is larger than 2^28 values");
    values *= block.count[i];
  }
  std::vector<double> data(values);
  if (const int status = get(variable, block, data); status != NC_NOERR)
    throw error(variable, std::string("cannot be read (") + nc_strerror(status) + ")");
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
