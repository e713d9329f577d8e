#include "sim/netcdf/classic_size.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <system_error>
#include <vector>

namespace earshot::netcdf {
namespace {

// Beyond these a header is nonsense: whoever believed it would read a vast file to its end, or take a product for small that has run over:
// - entries of any list
constexpr std::uint64_t kMostEntries = 1'000'000;
// - dimensions of a variable: NC_MAX_VAR_DIMS
constexpr std::uint64_t kMostDimensions = 1024;
// - values of a variable: their bytes still have a number
constexpr std::uint64_t kMostValues = std::uint64_t{1} << 60U;

constexpr std::array<std::uint64_t, 12> kTypeSize = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // by nc_type, NC_BYTE = 1 to NC_UINT64 = 11

std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + 3) / 4 * 4;
}

struct Variable {
  bool is_record = false;
  std::uint64_t bytes = 0;  ///< of one record, or of all of it
  std::uint64_t begin = 0;
};

/// Reads the big-endian header front to back; after a failure every further number is 0 and `ok` stays false.
class Header {
 public:
  explicit Header(const std::filesystem::path& path) : stream_(path, std::ios::binary) {
    std::error_code unreadable;
    file_bytes_ = std::filesystem::file_size(path, unreadable);
    std::array<char, 4> magic{};
    stream_.read(magic.data(), 4);
    version_ = magic[3];
    ok = stream_.good() && magic[0] == 'C' && magic[1] == 'D' && magic[2] == 'F' && (version_ == 1 || version_ == 2 || version_ == 5);
  }

  std::uint64_t number(int bytes) {
    std::array<unsigned char, 8> raw{};
    stream_.read(reinterpret_cast<char*>(raw.data()), bytes);
    ok = ok && stream_.good();
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value * 256 + raw[static_cast<std::size_t>(i)];
    return ok ? value : 0;
  }

  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
  std::uint64_t offset() { return number(version_ == 1 ? 4 : 8); }

  std::uint64_t list_length() {
    (void)number(4);  // the tag of the list
    const std::uint64_t length = count();
    ok = ok && length <= kMostEntries;
    return ok ? length : 0;
  }

  std::uint64_t type_size() {
    const std::uint64_t type = number(4);
    ok = ok && type >= 1 && type < kTypeSize.size();
    return ok ? kTypeSize[static_cast<std::size_t>(type)] : 0;
  }

  /// What is longer than the whole file is not there; and a step that large could lead backwards.
  void skip(std::uint64_t values, std::uint64_t bytes_of_each) {
    ok = ok && values <= file_bytes_ / std::max<std::uint64_t>(bytes_of_each, 1);
    if (ok) stream_.seekg(static_cast<std::streamoff>(padded(values * bytes_of_each)), std::ios::cur);
  }
  void skip_name() { skip(count(), 1); }

  void skip_attributes() {
    for (std::uint64_t i = list_length(); ok && i > 0; --i) {
      skip_name();
      const std::uint64_t size = type_size();
      skip(count(), size);
    }
  }

  [[nodiscard]] std::uint64_t streaming_mark() const { return version_ == 5 ? ~std::uint64_t{0} : 0xFFFFFFFFU; }

  bool ok = false;

 private:
  std::ifstream stream_;
  std::uint64_t file_bytes_ = 0;
  char version_ = 0;
};

Variable read_variable(Header& header, const std::vector<std::uint64_t>& dimensions) {
  Variable variable;
  header.skip_name();
  std::uint64_t values = 1;
  const std::uint64_t rank = header.count();
  header.ok = header.ok && rank <= kMostDimensions;
  for (std::uint64_t i = 0; header.ok && i < rank; ++i) {
    const std::uint64_t dimension = header.count();
    header.ok = header.ok && dimension < dimensions.size();
    if (!header.ok) return variable;
    const std::uint64_t length = dimensions[static_cast<std::size_t>(dimension)];
    if (length == 0) {
      variable.is_record = true;
    } else {
      header.ok = values <= kMostValues / length;
      values *= length;
    }
  }
  header.skip_attributes();
  variable.bytes = values * header.type_size();
  (void)header.count();  // vsize, which says the same padded, and not for large variables
  variable.begin = header.offset();
  return variable;
}

std::uint64_t end_of_data(const std::vector<Variable>& variables, std::uint64_t records) {
  std::uint64_t record_bytes = 0;
  const auto record_variables = std::count_if(variables.begin(), variables.end(), [](const Variable& v) { return v.is_record; });
  for (const Variable& v : variables) {
    if (v.is_record) record_bytes += record_variables == 1 ? v.bytes : padded(v.bytes);
  }
  std::uint64_t end = 0;
  for (const Variable& v : variables) {
    if (v.is_record && records == 0) continue;
    end = std::max(end, v.begin + v.bytes + (v.is_record ? (records - 1) * record_bytes : 0));
  }
  return end;
}

}  // namespace

std::optional<std::uint64_t> classic_size(const std::filesystem::path& path) {
  Header header(path);
  std::uint64_t records = header.count();
  if (records == header.streaming_mark()) records = 0;
  std::vector<std::uint64_t> dimensions;
  for (std::uint64_t i = header.list_length(); header.ok && i > 0; --i) {
    header.skip_name();
    dimensions.push_back(header.count());
  }
  header.skip_attributes();
  std::vector<Variable> variables;
  for (std::uint64_t i = header.list_length(); header.ok && i > 0; --i) variables.push_back(read_variable(header, dimensions));
  if (!header.ok) return std::nullopt;
  return end_of_data(variables, records);
}

}  // namespace earshot::netcdf
