#include "sim/netcdf/header.hpp"

#include <netcdf.h>

#include <array>
#include <cstring>
#include <utility>

#include "sim/netcdf/packing.hpp"
#include "sim/netcdf/text_attribute.hpp"

namespace earshot::netcdf {
namespace {

using Name = std::array<char, NC_MAX_NAME + 1>;

/// @param id  of a variable, or NC_GLOBAL
std::map<std::string, std::string> read_texts(int file, int id) {
  std::map<std::string, std::string> texts;
  int attributes = 0;
  (void)nc_inq_varnatts(file, id, &attributes);
  for (int i = 0; i < attributes; ++i) {
    Name attribute{};
    if (nc_inq_attname(file, id, i, attribute.data()) != NC_NOERR) continue;
    if (std::optional<std::string> text = text_attribute(file, id, attribute.data())) texts.emplace(attribute.data(), *std::move(text));
  }
  return texts;
}

std::optional<Variable> read_variable(int file, int id, Name& name) {
  int rank = 0;
  std::vector<int> dimensions(NC_MAX_VAR_DIMS);
  if (nc_inq_var(file, id, name.data(), nullptr, &rank, dimensions.data(), nullptr) != NC_NOERR) return std::nullopt;
  Variable variable;
  for (int i = 0; i < rank; ++i) {
    const int dimension = dimensions[static_cast<std::size_t>(i)];
    Name called{};
    std::size_t length = 0;
    if (nc_inq_dimname(file, dimension, called.data()) != NC_NOERR || nc_inq_dimlen(file, dimension, &length) != NC_NOERR)
      return std::nullopt;
    variable.dimensions.push_back({.name = called.data(), .length = length});
  }
  variable.texts = read_texts(file, id);
  variable.packing_fault = Packing(file, id).fault();
  return variable;
}

void add(std::string& bytes, std::size_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void add(std::string& bytes, const std::string& text) {
  add(bytes, text.size());
  bytes += text;
}

/// Takes what add() has added. Once something is not there, nothing is.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

  std::size_t number() {
    std::size_t number = 0;
    if (const std::string_view taken = take(sizeof number); !taken.empty()) std::memcpy(&number, taken.data(), sizeof number);
    return number;
  }
  std::string text() { return std::string(take(number())); }
  [[nodiscard]] bool are_sound() const { return are_sound_; }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t size) {
    are_sound_ = are_sound_ && size <= bytes_.size();
    if (!are_sound_) return {};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
  bool are_sound_ = true;
};

}  // namespace

Header read_header(int file) {
  Header header;
  header[""].texts = read_texts(file, NC_GLOBAL);
  int variables = 0;
  (void)nc_inq_nvars(file, &variables);
  for (int id = 0; id < variables; ++id) {
    Name name{};
    if (std::optional<Variable> variable = read_variable(file, id, name)) header.emplace(name.data(), *std::move(variable));
  }
  return header;
}

std::string to_bytes(const Header& header) {
  std::string bytes;
  for (const auto& [name, variable] : header) {
    add(bytes, name);
    add(bytes, variable.dimensions.size());
    for (const Dimension& dimension : variable.dimensions) {
      add(bytes, dimension.name);
      add(bytes, dimension.length);
    }
    add(bytes, variable.texts.size());
    for (const auto& [attribute, text] : variable.texts) {
      add(bytes, attribute);
      add(bytes, text);
    }
    add(bytes, variable.packing_fault);
  }
  return bytes;
}

std::optional<Header> header_from(std::string_view from) {
  Header header;
  Bytes bytes(from);
  while (bytes.are_sound() && !bytes.empty()) {
    Variable& variable = header[bytes.text()];
    for (std::size_t left = bytes.number(); left > 0 && bytes.are_sound(); --left) {
      std::string name = bytes.text();
      variable.dimensions.push_back({.name = std::move(name), .length = bytes.number()});
    }
    for (std::size_t left = bytes.number(); left > 0 && bytes.are_sound(); --left) {
      std::string attribute = bytes.text();
      variable.texts[std::move(attribute)] = bytes.text();
    }
    variable.packing_fault = bytes.text();
  }
  if (!bytes.are_sound()) return std::nullopt;
  return header;
}

}  // namespace earshot::netcdf
