#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace earshot::netcdf {

/// How many bytes a file of the classic NetCDF formats (CDF-1, CDF-2, CDF-5) must have at least, by its own header; nothing when the header
/// cannot be read. The NetCDF library reads zeros past the end of a truncated classic file and reports success.
///
/// Source: NetCDF classic format specification, "The NetCDF Classic Format Specification", NetCDF User's Guide, appendix B.
/// Oracle: NetcdfReader.RefusesEveryTruncation
[[nodiscard]] std::optional<std::uint64_t> classic_size(const std::filesystem::path& path);

}  // namespace earshot::netcdf
