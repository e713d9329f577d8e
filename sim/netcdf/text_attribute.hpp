#pragma once

#include <optional>
#include <string>

namespace earshot::netcdf {

/// The text of an attribute, which is an array of characters (NC_CHAR) or, as h5netcdf and xarray write it, one string (NC_STRING).
/// Nothing where there is none, or of another type.
/// @param file, variable  the library's own numbers
[[nodiscard]] std::optional<std::string> text_attribute(int file, int variable, const char* attribute);

}  // namespace earshot::netcdf
