#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::netcdf {

struct Dimension {
  std::string name;
  std::size_t length = 0;
};

struct Variable {
  std::vector<Dimension> dimensions;
  std::map<std::string, std::string> texts;  ///< attributes that are texts, by name
  std::string packing_fault{};               ///< Packing::fault()
};

/// What a file says of its values: the variables of its root group, by name; by the empty name the texts about the file.
using Header = std::map<std::string, Variable>;

/// Of an open file. What the library cannot tell of a variable, or of an attribute, is left out.
/// @param file  the library's own number of it
[[nodiscard]] Header read_header(int file);

/// For another process of this machine.
[[nodiscard]] std::string to_bytes(const Header& header);
/// Nothing where the bytes are none that to_bytes() gives. Oracle: NetcdfHeader.*
[[nodiscard]] std::optional<Header> header_from(std::string_view bytes);

}  // namespace earshot::netcdf
